#pragma once
#include <hagen/recordings/ScanSource.h>
#include <hagen/scan/SensorModel.h>
#include <pybind11/numpy.h>

#include <memory>
#include <optional>
#include <string>

namespace hagen::python {

/// A scan for Python: its arrays, and the observation that the filter reads.
struct PythonScan {
    recordings::RecordedScan recorded;
    /// The recording, which may name the sensor; null for simulated scans.
    std::shared_ptr<const recordings::ScanSource> source;

    pybind11::array_t<float> xyz;        ///< (N, 3) [m]
    pybind11::array_t<float> intensity;  ///< (N,)
    pybind11::object ring;               ///< (N,) uint8, or None
    pybind11::object times;              ///< (N,) float32 [s], or None
    double time_s = 0;                   ///< [s] since 1970
    SensorModel sensor;
    std::string remark;

    // None unless the scan is simulated.
    pybind11::object truth = pybind11::none();   ///< (N,) uint8
    pybind11::object kind = pybind11::none();    ///< (N,) uint8
    pybind11::object object = pybind11::none();  ///< (N,) uint16
    std::optional<double> altitude_m;
};

/// Fills the arrays from the recorded observation, whose returns keep their order. Requires the
/// GIL, and releases it while reading. Throws std::runtime_error naming the entry.
void readArrays(PythonScan& scan);

/// The pose as a matrix (4, 4), or None.
pybind11::object poseOf(const PythonScan& scan);
/// The attitude as (roll, pitch) [rad], or None.
pybind11::object attitudeOf(const PythonScan& scan);

}  // namespace hagen::python
