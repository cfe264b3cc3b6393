#include "PythonScan.h"

#include <hagen/mrpt/MrptMessage.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/mrpt/TimeStamp.h>

#include <stdexcept>

#include "Arrays.h"
#include "GilRelease.h"

namespace hagen::python {

namespace py = pybind11;

void readArrays(PythonScan& scan) {
    observations::ObservedScan observed;
    {
        const GilRelease gil_release;
        const Settings nothing_named;
        try {
            readObservation(*scan.recorded.observation,
                            scan.source ? scan.source->settingsFor(nothing_named) : nothing_named,
                            observed, scan.recorded.beams);
        } catch (const std::runtime_error& e) {
            throw std::runtime_error(recordings::titleOf(scan.recorded) + ": " + e.what());
        }
    }
    const Scan& returns = observed.scan;
    scan.xyz = pointsOf(returns);
    scan.intensity = copied(returns.intensity);
    scan.ring = observed.sensor.has_rings ? py::object(copied(returns.row)) : py::none();
    scan.times = returns.time_s.empty() ? py::none() : py::object(copied(returns.time_s));
    scan.time_s = observations::secondsOf(scan.recorded.observation->timestamp);
    scan.sensor = observed.sensor;
    scan.remark = observed.remark;
}

py::object poseOf(const PythonScan& scan) {
    const auto& pose = scan.recorded.pose.sensor_pose;
    if (!pose) return py::none();
    const auto matrix = pose->getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
    py::array_t<double> values({4, 4});
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column)
            values.mutable_at(row, column) = matrix(row, column);
    }
    return std::move(values);
}

py::object attitudeOf(const PythonScan& scan) {
    const auto& attitude = scan.recorded.pose.attitude;
    if (!attitude) return py::none();
    return py::make_tuple(attitude->roll_rad, attitude->pitch_rad);
}

}  // namespace hagen::python
