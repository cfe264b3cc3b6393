// The Python module hagen._hagen; users import it through python/hagen/__init__.py.
#include <hagen/evaluation/ScanScores.h>
#include <hagen/settings/Presets.h>
#include <hagen/settings/Settings.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "Arrays.h"
#include "FilledCaster.h"
#include "Filter.h"
#include "GilRelease.h"
#include "Limits.h"
#include "Sources.h"
#include "Texts.h"

namespace py = pybind11;

namespace hagen::python {
namespace {

/// Reads settings from presets or files, as with -c, and from single options.
Settings settingsFrom(const py::args& names, const py::kwargs& options) {
    Settings settings;
    const py::object fsencode = py::module_::import("os").attr("fsencode");
    for (const auto& name : names) {
        mergeSettings(presetFile(fsencode(name).cast<std::string>()), settings);
    }
    for (const auto& [key, value] : options) {
        std::string text = textOf(value);
        if (py::isinstance<py::bool_>(value)) text = value.cast<bool>() ? "true" : "false";
        setOption(textOf(key), text, settings);
    }
    return settings;
}

std::optional<Attitude> attitudeFrom(const py::object& attitude) {
    if (attitude.is_none()) return std::nullopt;
    const auto wrong = [&] {
        return py::value_error("attitude: expected (roll, pitch) [rad], each within +-2 pi, not " +
                               textOf(attitude));
    };
    constexpr double kMax_rad = 6.2832;  // 2 pi, rounded up for float32
    const auto isAngle = [](double angle_rad) { return std::abs(angle_rad) <= kMax_rad; };
    try {
        const auto [roll_rad, pitch_rad] = attitude.cast<std::pair<double, double>>();
        if (!isAngle(roll_rad) || !isAngle(pitch_rad)) throw wrong();
        return Attitude{static_cast<float>(roll_rad), static_cast<float>(pitch_rad)};
    } catch (const py::cast_error&) {
        throw wrong();
    }
}

std::optional<Eigen::Isometry3d> poseFrom(const py::object& pose) {
    if (pose.is_none()) return std::nullopt;
    const auto matrix = py::array_t<double, py::array::forcecast>::ensure(pose);
    if (!matrix || matrix.ndim() != 2 || matrix.shape(0) != 4 || matrix.shape(1) != 4) {
        PyErr_Clear();
        throw py::value_error("pose: expected a (4, 4) transform, not " + textOf(pose));
    }
    Eigen::Isometry3d map_from_sensor;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column)
            map_from_sensor.matrix()(row, column) = matrix.at(row, column);
    }
    const Eigen::Matrix4d& m = map_from_sensor.matrix();
    const Eigen::Matrix3d square = map_from_sensor.linear() * map_from_sensor.linear().transpose();
    if (!m.allFinite() || !square.isIdentity(1e-3) || m.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
        throw py::value_error("pose: expected a rotation and a translation");
    }
    return map_from_sensor;
}

std::shared_ptr<Segmented> segment(Filter& filter, const py::object& scan,
                                   const py::object& attitude, const py::object& pose) {
    const std::optional<Attitude> tilt = attitudeFrom(attitude);
    const std::optional<Eigen::Isometry3d> map_from_sensor = poseFrom(pose);
    std::shared_ptr<Segmented> segmented;
    if (py::isinstance<PythonScan>(scan)) {
        const auto& recorded = scan.cast<const PythonScan&>();
        const GilRelease gil_release;
        segmented = filter.segment(recorded, tilt);
    } else {
        const py::array_t<float> points = pointsFrom(scan);
        const PointsView view = viewOf(points);
        const GilRelease gil_release;
        segmented = filter.segment(view, tilt, map_from_sensor);
    }
    for (const std::string& warning : filter.newWarnings()) {
        if (PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 1) != 0) throw py::error_already_set();
    }
    return segmented;
}

/// Measures the C++ filter alone on these points [s], for benchmarks/python/python_speed.py.
std::vector<double> timesWithoutPython(const Filter& filter, const py::object& xyz, int runs) {
    Scan scan;
    copyPoints(viewOf(pointsFrom(xyz)), scan);
    HagenFilter alone = filterFor(filter.sensor(), filter.settings().options);
    std::vector<double> seconds;
    for (int run = 0; run < runs; ++run) {
        const auto start = std::chrono::steady_clock::now();
        locateBeams(alone.sensor(), scan);
        alone.segment(scan);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        seconds.push_back(taken.count());
    }
    return seconds;
}

py::dict stagesOf(const py::object& self) {
    const auto& r = self.cast<const Segmented&>().result;
    py::dict stages;
    const auto add = [&](const char* name, const auto& image) {
        if (image.size() > 0) stages[name] = shared(image, self);
    };
    add("depth_m", r.range_image.depth_m);
    add("repaired_m", r.repaired_m);
    add("proximity_m", r.proximity_m);
    add("sharpened_m", r.sharpened_m);
    add("merged_m", r.merged_m);
    add("range_angle_rad", r.range_angle_rad);
    add("smoothed_rad", r.smoothed_rad);
    add("pixel_angle_rad", r.pixel_angle_rad);
    add("labels", r.labels);
    add("components", r.components);
    if (r.ground.has_surface) {  // otherwise the images are from an earlier scan
        add("height_m", r.ground.height_m);
        add("tolerance_m", r.ground.tolerance_m);
    }
    return stages;
}

py::array_t<float> xyzOf(const Segmented& segmented) {
    const Scan& scan = segmented.scan;
    py::array_t<float> xyz({static_cast<py::ssize_t>(scan.size()), py::ssize_t{3}});
    auto to = xyz.mutable_unchecked<2>();
    for (py::ssize_t i = 0; i < to.shape(0); ++i) {
        to(i, 0) = scan.x_m[static_cast<std::size_t>(i)];
        to(i, 1) = scan.y_m[static_cast<std::size_t>(i)];
        to(i, 2) = scan.z_m[static_cast<std::size_t>(i)];
    }
    return xyz;
}

py::object groundOf(const Segmented& segmented) {
    const Ground& ground = segmented.result.ground;
    if (!ground.is_seen) return py::none();
    py::array_t<float> from_sensor({4, 4});
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column)
            from_sensor.mutable_at(row, column) = ground.from_sensor.matrix()(row, column);
    }
    return from_sensor;
}

evaluation::Scores evaluate(const py::object& labels, const py::object& truth,
                            const py::object& xyz, double max_range_m) {
    checkLimits("max_range_m", max_range_m, 0.1, 1000);  // as in segmentation-evaluate
    evaluation::GroundTruthScan scan;
    const std::vector<Label> found = labelsFrom(labels, "labels");
    scan.truth = labelsFrom(truth, "truth");
    if (found.size() != scan.truth.size()) {
        throw py::value_error("numbers of labels (" + std::to_string(found.size()) +
                              ") and true labels (" + std::to_string(scan.truth.size()) +
                              ") differ");
    }
    if (xyz.is_none()) {
        scan.input.scan.range_m.assign(found.size(), 0);
    } else {
        copyPoints(viewOf(pointsFrom(xyz)), scan.input.scan);
        if (scan.input.scan.size() != found.size()) {
            throw py::value_error("numbers of labels (" + std::to_string(found.size()) +
                                  ") and points (" + std::to_string(scan.input.scan.size()) +
                                  ") differ");
        }
        locateBeams(sensorModel("VLP-16"), scan.input.scan);  // only the ranges are used
    }
    evaluation::RangeBands bands;
    bands.max_range_m = static_cast<float>(max_range_m);
    return evaluation::scoreScan(scan, found, {}, bands).all;
}

std::string scoresText(const evaluation::Scores& scores) {
    const auto text = [](double f1) {
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.4f", f1);
        return std::string(digits);
    };
    return "<hagen.Scores: F1 of RoI " + text(scores.roi.f1()) + ", of ROU " +
           text(scores.rou.f1()) + ", " + std::to_string(scores.returns()) + " returns>";
}

void defineScan(py::module_& m) {
    py::class_<PythonScan>(m, "Scan", R"(A scan of a recording or of a simulated flight.

Arrays have one entry per return, in the recording's order. Points are in the sensor's frame: x
forward, y left, z up.)")
        .def_readonly("xyz", &PythonScan::xyz, "(N, 3) float32: coordinates [m]")
        .def_readonly("intensity", &PythonScan::intensity, "(N,) float32: 0 to 1")
        .def_readonly("ring", &PythonScan::ring,
                      R"((N,) uint8: beam number, counted from the lowest.
None for a sensor without rings.)")
        .def_readonly("times", &PythonScan::times, R"((N,) float32: time of each return since the
scan's first firing [s]. None if unknown.)")
        .def_readonly("time", &PythonScan::time_s, "Time of the scan [s since 1970].")
        .def_property_readonly(
            "sensor_label", [](const PythonScan& scan) { return shownText(scan.sensor_label); },
            "The label of the LiDAR in the recording; invalid UTF-8 bytes become U+FFFD.")
        .def_property_readonly(
            "sensor", [](const PythonScan& scan) { return shownText(scan.sensor.name); },
            R"(The sensor model, such as 'VLP-16'; 'recovered' if the beams were estimated
from the clouds.)")
        .def_readonly("pose", &PythonScan::pose,
                      R"((4, 4) float64: transform from the sensor's frame at
the scan's time to the map frame. None if unknown.)")
        .def_readonly("attitude", &PythonScan::attitude, R"((roll, pitch) of the sensor relative to
the horizon [rad]; None if unknown. See Filter.segment().)")
        .def_readonly("entry", &PythonScan::entry,
                      "Index of the scan in the recording; all scans of a sensory frame share it.")
        .def_property_readonly(
            "name", [](const PythonScan& scan) { return fileText(scan.name); },
            "File name without extension; empty for rawlogs, captures and bags.")
        .def_property_readonly(
            "remark", [](const PythonScan& scan) { return shownText(scan.remark); },
            "Remark about this scan; may be empty.")
        .def_readonly("truth", &PythonScan::truth, R"((N,) uint8: true labels of a simulated scan:
terrain and canopy are ROU, dust and the airframe are unclassified, all other objects are RoI at
all ranges. Otherwise None.)")
        .def_readonly("kind", &PythonScan::kind,
                      R"((N,) uint8: classes of a simulated scan: 1 terrain,
2 canopy, 3 tree, 4 pole, 5 wire, 6 building, 7 vehicle, 8 wall, 9 mover, 10 dust, 11 airframe.
Otherwise None.)")
        .def_readonly("object", &PythonScan::object, R"((N,) uint16: number of the object in a
simulated scene; 0 for no object. Otherwise None.)")
        .def_readonly("altitude_m", &PythonScan::altitude_m,
                      R"(Height of the sensor above the ground
of a simulated scene [m]; otherwise None.)")
        .def("__len__", [](const PythonScan& scan) { return scan.xyz.shape(0); })
        .def("__repr__", [](const PythonScan& scan) {
            return shownText("<hagen.Scan: " + std::to_string(scan.xyz.shape(0)) + " returns of '" +
                             scan.sensor_label + "' (" + scan.sensor.name + "), scan " +
                             std::to_string(scan.entry) + ">");
        });
}

void defineResult(py::module_& m) {
    py::class_<Segmented, std::shared_ptr<Segmented>>(m, "Result",
                                                      R"(The filter's result for one scan.

Arrays share the memory of the result (about 1 MB for a VLP-16) and keep it alive. To keep labels
of many scans, copy them: result.labels.copy().)")
        .def_property_readonly(
            "labels",
            [](const py::object& self) {
                return shared(self.cast<const Segmented&>().result.returns.label, self);
            },
            R"((N,) uint8: the label of each return, in the scan's order: 0 unclassified (no range),
1 ROU (ground, far returns), 2 RoI (a near obstacle).)")
        .def_property_readonly(
            "xyz", [](const Segmented& segmented) { return xyzOf(segmented); },
            R"((N, 3) float32: the labelled returns [m]: the scan or, with label_window, all
scans of the window, newest first, in the frame of the newest.)")
        .def_property_readonly(
            "obstacles",
            [](const py::object& self) {
                return shared(self.cast<const Segmented&>().result.returns.component, self);
            },
            "(N,) int32: obstacle (RoI component) of each return, 1 for the nearest; 0 if none.")
        .def_property_readonly(
            "heights", [](const Segmented& segmented) { return copied(heightsOf(segmented)); },
            R"((N,) float32: the height of each return above the ground surface [m], computed on
access. NaN for returns without a range; all NaN if no ground was visible.)")
        .def_property_readonly("ground", &groundOf,
                               R"((4, 4) float32: transform from the sensor's frame to
the ground frame, whose z = 0 is the mean ground plane. None if no ground was visible.)")
        .def_property_readonly("stages", &stagesOf,
                               R"(The images of the stages: a dict from names to
2D arrays, rows x columns.

Row 0 is the lowest beam. Column 0 points backwards, the middle column along x; columns run
clockwise. NaN means no value. With raw_angles, proximity_m, sharpened_m, merged_m and smoothed_rad
are empty.

depth_m          range of the closest return in each pixel [m]
repaired_m       depth_m without one-pixel gaps
proximity_m      zone_m - depth, at least 0
sharpened_m      proximity (or depth) with its maxima sharpened
merged_m         sharpened image, converted back to depth
range_angle_rad  angle from each beam to the beam above it; one row less
smoothed_rad     range_angle_rad after singular spectrum analysis
pixel_angle_rad  angle of each pixel, used for labelling
labels           uint8: label of each pixel, as for returns
components       int32: obstacles, numbered from the nearest
height_m         height above the ground surface; only if there is a surface
tolerance_m      maximum height of ground pixels; only if there is a surface)")
        .def_property_readonly(
            "sensor", [](const Segmented& segmented) { return shownText(segmented.sensor); },
            "The sensor model; 'recovered' if its beams were estimated from scans.")
        .def_property_readonly(
            "remark", [](const Segmented& segmented) { return shownText(segmented.remark); },
            "Remark about this scan; may be empty.")
        .def("__len__", [](const Segmented& segmented) { return segmented.scan.size(); })
        .def("__repr__", [](const Segmented& segmented) {
            const LabelledReturns& returns = segmented.result.returns;
            return "<hagen.Result: " + std::to_string(segmented.scan.size()) + " returns, " +
                   std::to_string(returns.roi.size()) + " RoI, " +
                   std::to_string(returns.rou.size()) + " ROU>";
        });
}

void defineFilter(py::module_& m) {
    py::class_<Filter>(m, "Filter",
                       R"(The Hagen filter: separates near obstacles (RoI) from ground and
far returns (ROU) in a LiDAR scan, without a map.

    filter = hagen.Filter("vlp16")
    result = filter.segment(xyz)          # (N, 3) [m], x forward, y left, z up
    near = xyz[result.labels == hagen.ROI]

Reuse a filter, because it keeps its memory. It has no other state, unless window_scans is above 1,
and is thread-safe.)")
        .def(py::init([](const py::args& settings, const py::kwargs& options) {
                 return std::make_unique<Filter>(settingsFrom(settings, options));
             }),
             R"(Filter(*settings, **options)

settings: presets (hagen.presets()) or settings files; later ones override earlier ones. Without a
named sensor, beams are estimated from the arrays of points.
options: single options, such as zone_m=15 or beta_deg=7.5; see docs/settings.md.
Raises hagen.SettingsError.)")
        .def("segment", &segment, py::arg("scan"), py::arg("attitude") = py::none(),
             py::arg("pose") = py::none(),
             R"(Segments one scan, which may be empty.

scan: an array of shape (N, 3) with x, y, z of each return in the sensor's frame [m], for the sensor
in the settings; types other than float32 are converted. Or a Scan from hagen.open() or
hagen.simulate(), which has its own sensor, beams, tilt and mount, as in rawlog-segment.
attitude: (roll, pitch) of the sensor relative to the horizon [rad], if known: pitch about y (nose
down is positive), then roll about x (left side up is positive). The sensor may then be mounted at
an arbitrary angle.
pose: (4, 4) transform from the sensor's frame to the map, for the sliding window (window_scans) of
arrays of points, in order and from one thread; ignored for recorded scans.

Warns (UserWarning) if most results so far are suspicious, such as scans without ground.
Raises ValueError for other shapes and for angles beyond +-2 pi. Releases the GIL.)")
        .def_property_readonly(
            "sensor", [](const Filter& filter) { return shownText(filter.sensor().name); },
            "The sensor model; 'recovered' if its beams were estimated from scans.")
        .def_property_readonly(
            "elevations_rad",
            [](const Filter& filter) { return copied(filter.sensor().elevations_rad); },
            "(rows,) float32: the elevation of each beam, from the lowest [rad].")
        .def_property_readonly(
            "settings",
            [](const Filter& filter) { return shownText(dumpSettings(filter.settings())); },
            "All settings as a settings file, with each key's unit and meaning in a comment.");
}

void defineScores(py::module_& m) {
    using evaluation::ClassScore;
    using evaluation::Scores;
    py::class_<ClassScore>(m, "ClassScore",
                           "Precision, recall and F1 of one class, and their counts.")
        .def_property_readonly("precision", &ClassScore::precision,
                               "Precision; NaN if no return was labelled as this class.")
        .def_property_readonly("recall", &ClassScore::recall,
                               "Recall; NaN if no return belongs to this class.")
        .def_property_readonly("f1", &ClassScore::f1, "F1; NaN if precision and recall are NaN.")
        .def_readonly("hits", &ClassScore::hits, "True positives.")
        .def_readonly("misses", &ClassScore::misses,
                      "False negatives, including unclassified returns.")
        .def_readonly("false_alarms", &ClassScore::false_alarms,
                      "False positives: returns labelled as this class that belong to the other.");
    py::class_<Scores>(m, "Scores", R"(Scores of both classes. Sums are micro-averages: counts are
summed over returns and scans before ratios are computed.)")
        .def(py::init<>())
        .def_readonly("roi", &Scores::roi, "Score of near obstacles.")
        .def_readonly("rou", &Scores::rou, "Score of ground and far returns.")
        .def_property_readonly("returns", &Scores::returns, "The number of scored returns.")
        .def_property_readonly("correct", &Scores::correct,
                               "The fraction with the correct label; NaN without returns.")
        .def(
            "__add__", [](Scores a, const Scores& b) { return a += b; }, py::is_operator())
        // Returns the object itself, which several names may refer to.
        .def(
            "__iadd__", [](Scores& a, const Scores& b) -> Scores& { return a += b; },
            py::return_value_policy::reference, py::is_operator())
        .def("__repr__", &scoresText);
    m.def("evaluate", &evaluate, py::arg("labels"), py::arg("truth"), py::arg("xyz") = py::none(),
          py::arg("max_range_m") = 20.0, R"(Scores labels against true labels, like
segmentation-evaluate.

labels, truth: (N,) labels, 0 unclassified, 1 ROU, 2 RoI. Returns whose true label is 0 are not
scored.
xyz: (N, 3) [m]; only returns up to max_range_m from the sensor are scored (default: all).
Raises ValueError for other shapes and labels, and for a max_range_m outside 0.1 to 1000.)");
}

}  // namespace
}  // namespace hagen::python

namespace {

newfunc new_object = nullptr;

/// Raises TypeError if pybind11's base class is called, as pickle does with old protocols; pybind11
/// would throw a C++ exception through Python.
PyObject* newObject(PyTypeObject* type, PyObject* args, PyObject* words) {
    PyObject* const base = py::detail::get_internals().instance_base;
    if (reinterpret_cast<PyObject*>(type) != base) return new_object(type, args, words);
    PyErr_SetString(PyExc_TypeError, "cannot be created or pickled");
    return nullptr;
}

void refuseObjectsOfNoClass() {
    auto* const base = reinterpret_cast<PyTypeObject*>(py::detail::get_internals().instance_base);
    if (base->tp_new == newObject) return;
    new_object = base->tp_new;
    base->tp_new = newObject;
}

}  // namespace

PYBIND11_MODULE(_hagen, m) {
    refuseObjectsOfNoClass();
    // pybind11 looks up NumPy for the first array. If two threads did so at once, they would
    // deadlock: one would wait for the GIL, the other for the first thread's result.
    py::dtype::of<float>();
    using namespace hagen;
    using namespace hagen::python;
    m.doc() = "Regions of interest in sparse LiDAR scans, without a map.";
    m.attr("__version__") = HAGEN_VERSION;
    m.attr("UNCLASSIFIED") = static_cast<int>(Label::Unclassified);
    m.attr("ROU") = static_cast<int>(Label::Rou);
    m.attr("ROI") = static_cast<int>(Label::Roi);
    py::register_exception<SettingsError>(m, "SettingsError", PyExc_ValueError);
    showErrorTexts();
    defineScan(m);
    defineResult(m);
    defineFilter(m);
    defineSources(m);
    defineScores(m);
    m.def(
        "presets",
        [] {
            py::list names;
            for (const std::string& name : presetNames(isSettingsFile))
                names.append(fileText(name));
            return names;
        },
        "The names of all presets for Filter().");
    m.def("_times_without_python", &timesWithoutPython, py::arg("filter"), py::arg("xyz"),
          py::arg("runs"));
    m.def("_add_presets", &addPresetFolder, py::arg("folder"));
}
