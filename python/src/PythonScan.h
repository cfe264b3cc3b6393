#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <pybind11/numpy.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace hagen::python {

/// What RecordedFilter segments. Two definitions: with_mrpt/Recorded.h and captures/Recorded.h.
struct Recorded;

/// A scan for Python: its arrays, and what the filter reads.
struct PythonScan {
    std::shared_ptr<const Recorded> recorded;

    std::string sensor_label, name;
    std::size_t entry = 0;
    pybind11::array_t<float> xyz;        ///< (N, 3) [m]
    pybind11::array_t<float> intensity;  ///< (N,)
    pybind11::object ring;               ///< (N,) uint8, or None
    pybind11::object times;              ///< (N,) float32 [s], or None
    double time_s = 0;                   ///< [s] since 1970
    SensorModel sensor;
    std::string remark;
    pybind11::object pose = pybind11::none();      ///< (4, 4)
    pybind11::object attitude = pybind11::none();  ///< (roll, pitch) [rad]

    // None unless the scan is simulated.
    pybind11::object truth = pybind11::none();   ///< (N,) uint8
    pybind11::object kind = pybind11::none();    ///< (N,) uint8
    pybind11::object object = pybind11::none();  ///< (N,) uint16
    std::optional<double> altitude_m;
};

/// Fills the arrays of returns, whose sensor is scan.sensor.
void copyReturns(const Scan& returns, PythonScan& scan);

}  // namespace hagen::python
