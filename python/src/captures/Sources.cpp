// Sources of scans without MRPT, for wheels: network captures.
#include "Sources.h"

#include <hagen/sensors/VelodyneDecoder.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "FilledCaster.h"
#include "PythonScan.h"
#include "Texts.h"
#include "captures/Recorded.h"
#include "sensors/captures/LidarCapture.h"

namespace hagen::python {

namespace py = pybind11;

namespace {

constexpr const char* kMissing =
    " not part of this wheel; use the Debian package python3-hagen (docs/python.md)";

/// The constructor's arguments except the file; docs in python/hagen/__init__.py.
struct Choice {
    std::vector<std::string> sensor_labels;
    std::size_t first = 0, last = std::numeric_limits<std::size_t>::max();
};

/// The sweep's sensor and returns, as read by observations::readObservation().
SensorModel readSweep(sensors::LidarSweep& sweep, Scan& returns, std::string& remark) {
    SensorModel sensor = *sweep.sensor;
    if (sweep.packets.empty()) {
        const std::vector<std::uint8_t> rows = std::move(sweep.returns.row);
        returns = std::move(sweep.returns);
        locateBeams(sensor, returns);
        returns.row = rows;  // exact even for near returns
        return sensor;
    }
    const sensors::VelodynePackets packets{sweep.packets.data(),
                                           sweep.packets.size() / sensors::kVelodynePacketBytes};
    beamsOf(packets, sweep.calibration, sensor);
    sensor.min_range_m = sweep.sensor->min_range_m;
    sensor.max_range_m = sweep.sensor->max_range_m;
    sensors::DecoderWorkspace work;
    const std::size_t skipped = decodePackets(packets, sweep.calibration, returns, work);
    if (skipped > 0) remark = std::to_string(skipped) + " packet blocks skipped";
    return sensor;
}

class Recording {
 public:
    Recording(const std::filesystem::path& file, Choice choice,
              const std::filesystem::path& sensor_json, const std::filesystem::path& calibration)
        : file_(file), choice_(std::move(choice)) {
        std::error_code error;
        if (!std::filesystem::exists(file, error)) {
            PyErr_SetObject(PyExc_FileNotFoundError,
                            shownText(file.string() + ": no such file").ptr());
            throw py::error_already_set();
        }
        if (std::filesystem::is_directory(file, error) || !sensors::isCapture(file)) {
            throw std::runtime_error(file.string() + ": not a network capture; other readers are" +
                                     kMissing);
        }
        capture_ = sensors::openCapture(file, sensor_json, calibration, [] {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        });
    }

    PythonScan next() {
        while (entry_ <= choice_.last) {
            std::optional<sensors::LidarSweep> sweep = capture_->nextSweep();
            if (!sweep) break;
            const std::size_t entry = entry_++;
            const auto& labels = choice_.sensor_labels;
            const bool is_wanted = labels.empty() || std::find(labels.begin(), labels.end(),
                                                               sweep->label) != labels.end();
            if (entry < choice_.first || !is_wanted) continue;
            auto recorded = std::make_shared<Recorded>();
            PythonScan scan;
            scan.sensor = readSweep(*sweep, recorded->returns, scan.remark);
            scan.sensor_label = sweep->label;
            scan.entry = entry;
            scan.time_s = static_cast<double>(sweep->time_ns) * 1e-9;
            copyReturns(recorded->returns, scan);
            scan.recorded = std::move(recorded);
            return scan;
        }
        throw py::stop_iteration();
    }

    std::vector<std::string> remarks() const { return capture_->remarks(); }
    const std::filesystem::path& file() const { return file_; }

 private:
    std::filesystem::path file_;
    Choice choice_;
    std::unique_ptr<sensors::LidarCapture> capture_;
    std::size_t entry_ = 0;
};

struct Simulation {};

[[noreturn]] void refuse(const char* what) {
    throw std::runtime_error(std::string(what) + kMissing);
}

}  // namespace

void defineSources(py::module_& m) {
    py::class_<Recording>(m, "Recording", "An open network capture, and an iterator of its scans.")
        .def(
            py::init(
                [](const std::filesystem::path& file, std::vector<std::string> sensor_labels,
                   const std::filesystem::path& poses, const std::filesystem::path& sensor_json,
                   const std::filesystem::path& calibration, const std::vector<std::string>& topics,
                   std::size_t first, std::optional<std::size_t> last) {
                    if (!poses.empty()) refuse("poses are");
                    if (!topics.empty()) refuse("topics are");
                    Choice choice{std::move(sensor_labels), first};
                    if (last) choice.last = *last;
                    return std::make_unique<Recording>(file, std::move(choice), sensor_json,
                                                       calibration);
                }),
            py::arg("file"), py::kw_only(), py::arg("sensor_labels") = std::vector<std::string>(),
            py::arg("poses") = "", py::arg("sensor_json") = "", py::arg("calibration") = "",
            py::arg("topics") = std::vector<std::string>(), py::arg("first") = 0,
            py::arg("last") = py::none())
        .def("__iter__", [](const py::object& self) { return self; })
        .def("__next__", &Recording::next)
        .def_property_readonly("poses", [](const Recording&) { return ""; })
        .def_property_readonly(
            "remarks", [](const Recording& recording) { return shownTexts(recording.remarks()); })
        .def("__repr__", [](const Recording& recording) {
            return shownText("<hagen.Recording: " + recording.file().string() + ">");
        });
    py::class_<Simulation>(m, "Simulation")
        .def(py::init([](const py::args&, const py::kwargs&) -> std::unique_ptr<Simulation> {
            refuse("the simulator is");
        }));
    m.def("scenarios", [] { refuse("the simulator is"); });
}

}  // namespace hagen::python
