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

}  // namespace hagen
