#include "with_mrpt/Recorded.h"

#include <hagen/mrpt/MrptMessage.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/mrpt/TimeStamp.h>

#include <stdexcept>

#include "GilRelease.h"

namespace hagen::python {

namespace py = pybind11;

namespace {

py::object matrixOf(const mrpt::poses::CPose3D& pose) {
    const auto matrix = pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
    py::array_t<double> values({4, 4});
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column)
            values.mutable_at(row, column) = matrix(row, column);
    }
    return values;
}

}  // namespace

PythonScan pythonScanOf(Recorded recorded) {
    observations::ObservedScan observed;
    const mrpt::obs::CObservation& observation = *recorded.scan.observation;
    {
        const GilRelease gil_release;
        const Settings nothing_named;
        try {
            readObservation(
                observation,
                recorded.source ? recorded.source->settingsFor(nothing_named) : nothing_named,
                observed, recorded.scan.beams);
        } catch (const std::runtime_error& e) {
            throw std::runtime_error(recordings::titleOf(recorded.scan) + ": " + e.what());
        }
    }
    PythonScan scan;
    scan.sensor_label = observation.sensorLabel;
    scan.name = recorded.scan.name;
    scan.entry = recorded.scan.entry;
    scan.time_s = observations::secondsOf(observation.timestamp);
    scan.sensor = observed.sensor;
    scan.remark = observed.remark;
    const observations::ScanPose& pose = recorded.scan.pose;
    if (pose.sensor_pose) scan.pose = matrixOf(*pose.sensor_pose);
    if (pose.attitude) {
        scan.attitude = py::make_tuple(pose.attitude->roll_rad, pose.attitude->pitch_rad);
    }
    copyReturns(observed.scan, scan);
    scan.recorded = std::make_shared<const Recorded>(std::move(recorded));
    return scan;
}

}  // namespace hagen::python
