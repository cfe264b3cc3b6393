#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace hagen::evaluation {

/// Points in the interface that nanoflann expects.
template <int kDimensions>
struct TreePoints {
    std::vector<Eigen::Matrix<float, kDimensions, 1>> at_m;

    std::size_t kdtree_get_point_count() const { return at_m.size(); }
    float kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return at_m[i][static_cast<Eigen::Index>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

}  // namespace hagen::evaluation
