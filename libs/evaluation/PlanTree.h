#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <nanoflann.hpp>
#include <vector>

namespace hagen::evaluation {

/// Neighbours of horizontal positions.
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
        All all{limit_m2, {}};
        if (!points_.at_m.empty()) tree_.findNeighbors(all, at_m.data(), {});
        return all.found;
    }
    /// Squared distance of the `count`-th nearest position, or of the farthest one if there are
    /// fewer. There must be one.
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

    /// The interfaces that nanoflann expects.
    struct Points {
        std::vector<Eigen::Vector2f> at_m;

        std::size_t kdtree_get_point_count() const { return at_m.size(); }
        float kdtree_get_pt(std::size_t i, std::size_t axis) const {
            return at_m[i][static_cast<Eigen::Index>(axis)];
        }
        template <class Box>
        bool kdtree_get_bbox(Box&) const {
            return false;
        }
    };
    struct All {
        float limit_m2;
        std::vector<std::uint32_t> found;

        bool addPoint(float, std::uint32_t point) {
            found.push_back(point);
            return true;
        }
        float worstDist() const { return limit_m2; }
        static std::size_t size() { return 1; }
        static bool full() { return true; }
    };
    Points points_;
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 2>
        tree_;
};

}  // namespace hagen::evaluation
