#include "Arrays.h"

#include <hagen/scan/MostReturns.h>

#include <cstring>

#include "Texts.h"

namespace hagen::python {

namespace py = pybind11;

namespace {

std::string shapeText(const py::array& array) { return textOf(array.attr("shape")); }

/// Converts an argument to an array. Exceptions become the cause of a ValueError with `text`,
/// except interrupts and MemoryError.
template <class Array>
Array converted(const py::object& values, const std::string& text) {
    try {
        return Array(values);
    } catch (py::error_already_set& error) {
        if (!error.matches(PyExc_Exception) || error.matches(PyExc_MemoryError)) throw;
        py::raise_from(error, PyExc_ValueError, text.c_str());
        throw py::error_already_set();
    }
}

/// Converts an object to an array; throws ValueError unless it contains real numbers.
py::array numbersFrom(const py::object& values, const std::string& expected) {
    // Converting a masked array would expose the masked values.
    if (py::hasattr(values, "mask") &&
        py::module_::import("numpy.ma").attr("is_masked")(values).cast<bool>()) {
        throw py::value_error("expected " + expected +
                              ", not an array with masked entries; remove them first");
    }
    const auto array = converted<py::array>(
        values, "expected " + expected + ", not " + textOf(py::type::of(values)));
    if (std::strchr("fiub", array.dtype().kind()) == nullptr) {
        throw py::value_error("expected " + expected + ", not an array of dtype " +
                              textOf(array.dtype()));
    }
    return array;
}

}  // namespace

py::array_t<float> pointsFrom(const py::object& points) {
    const std::string expected = "an array of shape (N, 3) with x, y, z [m] of each return";
    const py::array array = numbersFrom(points, expected);
    if (array.ndim() != 2 || array.shape(1) != 3) {
        const bool has_more = array.ndim() == 2 && array.shape(1) > 3;
        throw py::value_error("expected " + expected + ", not of shape " + shapeText(array) +
                              (has_more ? "; pass points[:, :3]" : ""));
    }
    if (static_cast<std::size_t>(array.shape(0)) > kMaxReturns) {  // checked before conversion
        throw py::value_error("the scan has " + std::to_string(array.shape(0)) +
                              " returns, more than the " + std::to_string(kMaxReturns) +
                              " allowed");
    }
    return converted<py::array_t<float, py::array::forcecast>>(
        array, "expected " + expected + ", not numbers that float32 cannot hold");
}

PointsView viewOf(const py::array_t<float>& points) {
    return {reinterpret_cast<const char*>(points.data()), static_cast<std::size_t>(points.shape(0)),
            points.strides(0), points.strides(1)};
}

void copyPoints(const PointsView& points, Scan& scan) {
    // Resizes without clearing, to avoid filling arrays twice; locateBeams() writes the other
    // arrays.
    for (auto* values : {&scan.x_m, &scan.y_m, &scan.z_m, &scan.intensity})
        values->resize(points.returns);
    scan.time_s.clear();
    float *const x_m = scan.x_m.data(), *const y_m = scan.y_m.data(), *const z_m = scan.z_m.data();
    constexpr std::ptrdiff_t kFloat = sizeof(float);
    const bool is_aligned = reinterpret_cast<std::uintptr_t>(points.data) % alignof(float) == 0;
    if (points.row_bytes == 3 * kFloat && points.column_bytes == kFloat && is_aligned) {
        const float* const xyz = reinterpret_cast<const float*>(points.data);
        for (std::size_t i = 0; i < points.returns; ++i) {
            x_m[i] = xyz[3 * i];
            y_m[i] = xyz[3 * i + 1];
            z_m[i] = xyz[3 * i + 2];
        }
        return;
    }
    const char* row = points.data;
    const auto at = [&](int column) {
        float value;  // NumPy slices of structures are unaligned
        std::memcpy(&value, row + column * points.column_bytes, sizeof value);
        return value;
    };
    for (std::size_t i = 0; i < points.returns; ++i, row += points.row_bytes) {
        x_m[i] = at(0);
        y_m[i] = at(1);
        z_m[i] = at(2);
    }
}

std::vector<Label> labelsFrom(const py::object& labels, const std::string& what) {
    const std::string expected =
        what + ": an array of shape (N,) with a label (0, 1, 2) per return";
    const py::array array = numbersFrom(labels, expected);
    if (array.ndim() != 1)
        throw py::value_error("expected " + expected + ", not of shape " + shapeText(array));
    const auto numbers = converted<py::array_t<double, py::array::forcecast>>(
        array, "expected " + expected + ", not numbers that float64 cannot hold");
    const auto values = numbers.unchecked<1>();
    std::vector<Label> found(static_cast<std::size_t>(values.shape(0)));
    for (py::ssize_t i = 0; i < values.shape(0); ++i) {
        const double value = values(i);
        if (value != 0 && value != 1 && value != 2) {
            throw py::value_error("expected " + expected + ", not " + textOf(array[py::int_(i)]) +
                                  " at " + std::to_string(i));
        }
        found[static_cast<std::size_t>(i)] = static_cast<Label>(static_cast<int>(value));
    }
    return found;
}

py::array_t<std::uint8_t> shared(const std::vector<Label>& labels, const py::object& owner) {
    return py::array_t<std::uint8_t>(static_cast<py::ssize_t>(labels.size()),
                                     reinterpret_cast<const std::uint8_t*>(labels.data()), owner);
}

py::array_t<std::uint8_t> shared(const Image<Label>& labels, const py::object& owner) {
    const py::ssize_t rows = labels.rows();
    return py::array_t<std::uint8_t>({rows, labels.cols()}, {py::ssize_t{1}, rows},
                                     reinterpret_cast<const std::uint8_t*>(labels.data()), owner);
}

py::array_t<float> pointsOf(const Scan& scan) {
    py::array_t<float> points({static_cast<py::ssize_t>(scan.size()), py::ssize_t{3}});
    auto values = points.mutable_unchecked<2>();
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const auto row = static_cast<py::ssize_t>(i);
        values(row, 0) = scan.x_m[i];
        values(row, 1) = scan.y_m[i];
        values(row, 2) = scan.z_m[i];
    }
    return points;
}

}  // namespace hagen::python
