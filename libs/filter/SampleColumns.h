#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

namespace hagen {

/// Samples evenly spaced columns of an image: at least `enough`, but fewer than 2 * `enough`, or
/// all columns of a narrower image.
inline void sampleColumns(Eigen::Index columns, Eigen::Index enough,
                          std::vector<std::int32_t>& sample) {
    const Eigen::Index step = std::max<Eigen::Index>(1, columns / enough);
    sample.clear();
    for (Eigen::Index column = 0; column < columns; column += step) {
        sample.push_back(static_cast<std::int32_t>(column));
    }
}

}  // namespace hagen
