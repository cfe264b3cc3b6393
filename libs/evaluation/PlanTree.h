#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <nanoflann.hpp>
#include <type_traits>
#include <utility>
#include <vector>
#include "evaluation/TreePoints.h"

namespace hagen::evaluation {

/// A search tree of horizontal positions.
class PlanTree {
 public:
    explicit PlanTree(std::vector<Eigen::Vector2f> at_m)
        : points_{std::move(at_m)}, tree_(2, points_, kLeafSize) {
        if (!points_.at_m.empty()) tree_.buildIndex();
    }
    PlanTree(const PlanTree&) = delete;
    PlanTree& operator=(const PlanTree&) = delete;

    /// Indices of all positions whose squared distance is below a limit, in no particular order.
    std::vector<std::uint32_t> within(const Eigen::Vector2f& at_m, float limit_m2) const {
        using Set = nanoflann::RadiusResultSet<float, std::uint32_t>;
        std::remove_reference_t<decltype(Set::m_indices_dists)> found;
        Set all(limit_m2, found);
        if (!points_.at_m.empty()) tree_.findNeighbors(all, at_m.data(), {});
        std::vector<std::uint32_t> indices;
        for (const auto& [index, distance_m2] : found) indices.push_back(index);
        return indices;
    }
    /// Squared distance of the `count`-th nearest position, or of the farthest one if there are
    /// fewer. Requires at least one position.
    float squaredDistanceOf(std::size_t count, const Eigen::Vector2f& at_m) const {
        std::vector<std::uint32_t> index(count);
        std::vector<float> distance_m2(count);
        const std::size_t found =
            tree_.knnSearch(at_m.data(), count, index.data(), distance_m2.data());
        return distance_m2[found - 1];
    }
    /// Whether the squared distance of any position is below a limit.
    bool isAnyWithin(const Eigen::Vector2f& at_m, float limit_m2) const {
        return !points_.at_m.empty() && squaredDistanceOf(1, at_m) < limit_m2;
    }

 private:
    static constexpr std::size_t kLeafSize = 16;

    using Points = TreePoints<2>;

    Points points_;
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 2>
        tree_;
};

}  // namespace hagen::evaluation
