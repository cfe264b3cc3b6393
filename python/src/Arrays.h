#pragma once
#include <hagen/scan/Image.h>
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <pybind11/numpy.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::python {

/// The coordinates of returns in NumPy's memory: float32, in an arbitrary layout.
struct PointsView {
    const char* data;
    std::size_t returns;
    std::ptrdiff_t row_bytes, column_bytes;
};

/// Returns an (N, 3) array of numbers as float32, without a copy if it is float32 already. Throws
/// ValueError for other shapes, for values that are not numbers and, if NumPy raises on overflow
/// (np.errstate(), warnings as errors), for numbers beyond float32.
pybind11::array_t<float> pointsFrom(const pybind11::object& points);
PointsView viewOf(const pybind11::array_t<float>& points);

/// Copies the coordinates into `scan`. All other arrays of `scan` are then undefined: call
/// locateBeams(). Needs no GIL.
void copyPoints(const PointsView& points, Scan& scan);

/// Returns an (N,) array of labels. Throws ValueError, naming the argument (`what`), for other
/// shapes and for numbers other than 0, 1, 2.
std::vector<Label> labelsFrom(const pybind11::object& labels, const std::string& what);

/// An array that shares memory with `owner` and keeps it alive.
template <class T>
pybind11::array_t<T> shared(const std::vector<T>& values, const pybind11::object& owner) {
    return pybind11::array_t<T>(static_cast<pybind11::ssize_t>(values.size()), values.data(),
                                owner);
}

/// Like above, for an image (rows x columns).
template <class T>
pybind11::array_t<T> shared(const Image<T>& image, const pybind11::object& owner) {
    const pybind11::ssize_t rows = image.rows(), size = sizeof(T);
    return pybind11::array_t<T>({rows, image.cols()}, {size, size * rows}, image.data(), owner);
}

/// Like above, for labels, which are uint8 in NumPy.
pybind11::array_t<std::uint8_t> shared(const std::vector<Label>& labels,
                                       const pybind11::object& owner);
pybind11::array_t<std::uint8_t> shared(const Image<Label>& labels, const pybind11::object& owner);

/// Returns a copy as an array.
template <class T>
pybind11::array_t<T> copied(const std::vector<T>& values) {
    return pybind11::array_t<T>(static_cast<pybind11::ssize_t>(values.size()), values.data());
}
pybind11::array_t<float> pointsOf(const Scan& scan);  ///< the coordinates, (N, 3)

}  // namespace hagen::python
