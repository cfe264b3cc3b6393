#include "Sources.h"

#include <hagen/simulation/Scenarios.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>
#include <utility>

#include "FilledCaster.h"
#include "Texts.h"
#include "with_mrpt/Recording.h"
#include "with_mrpt/Simulation.h"

namespace pybind11::detail {
template <>
class type_caster<hagen::python::Recording> : public FilledCaster<hagen::python::Recording> {};
template <>
class type_caster<hagen::python::Simulation> : public FilledCaster<hagen::python::Simulation> {};
}  // namespace pybind11::detail

namespace hagen::python {

namespace py = pybind11;

void defineSources(py::module_& m) {
    py::class_<Recording>(m, "Recording", "An open recording, and an iterator of its scans.")
        .def(py::init([](const std::filesystem::path& file, std::vector<std::string> sensor_labels,
                         const std::filesystem::path& poses,
                         const std::filesystem::path& sensor_json,
                         const std::filesystem::path& calibration, std::vector<std::string> topics,
                         std::size_t first, std::optional<std::size_t> last) {
                 recordings::SourceOptions options;
                 options.sensor_labels = std::move(sensor_labels);
                 options.sensor_json = sensor_json;
                 options.calibration = calibration;
                 options.topics = std::move(topics);
                 options.first_scan = first;
                 if (last) options.last_scan = *last;
                 return std::make_unique<Recording>(file, options, poses);
             }),
             py::arg("file"), py::kw_only(), py::arg("sensor_labels") = std::vector<std::string>(),
             py::arg("poses") = "", py::arg("sensor_json") = "", py::arg("calibration") = "",
             py::arg("topics") = std::vector<std::string>(), py::arg("first") = 0,
             py::arg("last") = py::none())
        .def("__iter__", [](const py::object& self) { return self; })
        .def("__next__",
             [](Recording& recording) {
                 auto scan = recording.next();
                 if (!scan) throw py::stop_iteration();
                 return std::move(*scan);
             })
        .def_property_readonly(
            "poses", [](const Recording& recording) { return shownText(recording.poseSource()); },
            "Source of the poses; empty without poses.")
        .def_property_readonly(
            "remarks", [](const Recording& recording) { return shownTexts(recording.remarks()); },
            R"(Remarks about the whole recording, such as missing
packets; complete after the last scan.)")
        .def("__repr__", [](const Recording& recording) {
            return shownText("<hagen.Recording: " + recording.file().string() + ">");
        });

    py::class_<Simulation>(m, "Simulation", "A simulated flight, and an iterator of its scans.")
        .def(py::init([](const std::string& scenario, int scans, std::uint64_t seed,
                         double altitude_m, const std::string& sensor, double speed_m_s,
                         double tilt_sd_deg, double every_s, bool clear_air) {
                 return std::make_unique<Simulation>(
                     SimulationRequest{scenario, scans, seed, sensor, altitude_m, speed_m_s,
                                       tilt_sd_deg, every_s, clear_air});
             }),
             py::arg("scenario"), py::arg("scans") = 1, py::arg("seed") = 1, py::kw_only(),
             py::arg("altitude_m") = 2.0, py::arg("sensor") = "VLP-16", py::arg("speed_m_s") = 4.0,
             py::arg("tilt_sd_deg") = 4.0, py::arg("every_s") = 0.1, py::arg("clear_air") = false)
        .def("__iter__", [](const py::object& self) { return self; })
        .def("__next__",
             [](Simulation& flight) {
                 auto scan = flight.next();
                 if (!scan) throw py::stop_iteration();
                 return std::move(*scan);
             })
        .def("__len__", &Simulation::scans)
        .def("__length_hint__", &Simulation::left);
    m.def("scenarios", &simulation::scenarioNames, "The names of all scenarios of simulate().");
}

}  // namespace hagen::python
