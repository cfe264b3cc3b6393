#pragma once
#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace hagen {

/// A range image of a rotating LiDAR: one row per beam (row 0 is the lowest), one column per
/// azimuth. Stored column by column, so that the returns of a firing are contiguous. The last
/// column is a neighbour of the first; rows do not wrap around.
template <class T>
using Image = Eigen::Array<T, Eigen::Dynamic, Eigen::Dynamic>;

/// The value of an empty pixel in float images.
constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();
inline bool hasValue(float pixel) { return !std::isnan(pixel); }

/// Wraps a column index that is at most 1 outside the image.
inline int wrapColumn(int column, int columns) {
    return column < 0 ? column + columns : column >= columns ? column - columns : column;
}

/// Calls visit(row, column) for the pixels above, below and on both sides of a pixel.
template <class Visit>
void forEachOf4Neighbours(int row, int column, int rows, int columns, Visit visit) {
    if (row > 0) visit(row - 1, column);
    if (row + 1 < rows) visit(row + 1, column);
    visit(row, wrapColumn(column - 1, columns));
    visit(row, wrapColumn(column + 1, columns));
}

}  // namespace hagen
