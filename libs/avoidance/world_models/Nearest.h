#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nanoflann.hpp>
#include "evaluation/TreePoints.h"

namespace hagen::avoidance {

/// A k-d tree of points in 3D.
using TreePoints = evaluation::TreePoints<3>;
using PointTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, TreePoints>, TreePoints,
                                        3>;

/// A result set for nanoflann: the minimum squared distance over several trees searched in turn. It
/// starts with a limit, so that searches beyond it end early.
class Nearest {
 public:
    using DistanceType = float;
    using IndexType = std::uint32_t;
    explicit Nearest(float limit_m) : min_m2_(limit_m * limit_m) {}

    /// Restricts the next tree to its first `points` points (at least 1) without hidden points
    /// (null: no point is hidden).
    void consider(std::size_t points, const std::uint8_t* is_hidden = nullptr) {
        counting_ = points;
        is_hidden_ = is_hidden;
    }

    bool addPoint(float distance_m2, std::uint32_t point) {
        if (point < counting_ && distance_m2 < min_m2_ && !(is_hidden_ && is_hidden_[point])) {
            min_m2_ = distance_m2;
        }
        return true;
    }
    float worstDist() const { return min_m2_; }
    static std::size_t size() { return 1; }
    static bool full() { return true; }
    static void sort() {}

 private:
    float min_m2_;
    const std::uint8_t* is_hidden_ = nullptr;
    std::size_t counting_ = std::numeric_limits<std::size_t>::max();
};

/// A result set for nanoflann: whether a tree has any point within a radius, among its first
/// `points` points except one. The search stops at the first match.
class AnyWithin {
 public:
    using DistanceType = float;
    using IndexType = std::uint32_t;
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    AnyWithin(float radius_m, std::size_t points, std::uint32_t but = kNone)
        : radius_m2_(radius_m * radius_m), points_(points), but_(but) {}

    bool addPoint(float, std::uint32_t point) {
        found_ |= point < points_ && point != but_;
        return !found_;
    }
    bool found() const { return found_; }
    float worstDist() const { return radius_m2_; }
    static std::size_t size() { return 1; }
    static bool full() { return true; }
    static void sort() {}

 private:
    float radius_m2_;
    std::size_t points_;
    std::uint32_t but_;
    bool found_ = false;
};

}  // namespace hagen::avoidance
