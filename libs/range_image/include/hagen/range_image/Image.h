#pragma once
#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace hagen {

/// An image over a rotating LiDAR's scan: a row a beam (row 0 the lowest), a column an azimuth.
/// Stored column by column, so that the returns of one firing lie together. Columns wrap around
/// (the last one is a neighbour of the first), rows do not.
template <class T>
using Image = Eigen::Array<T, Eigen::Dynamic, Eigen::Dynamic>;

/// What a pixel without a value holds, in every image of floats.
constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();
inline bool hasValue(float pixel) { return !std::isnan(pixel); }

/// A column one to the left or right of a valid one, wrapped around.
inline int wrapColumn(int column, int columns) {
    return column < 0 ? column + columns : column >= columns ? column - columns : column;
}

/// Calls visit(row, column) for the pixels above, below and to both sides of one.
template <class Visit>
void forEachOf4Neighbours(int row, int column, int rows, int columns, Visit visit) {
    if (row > 0) visit(row - 1, column);
    if (row + 1 < rows) visit(row + 1, column);
    visit(row, wrapColumn(column - 1, columns));
    visit(row, wrapColumn(column + 1, columns));
}

}  // namespace hagen
