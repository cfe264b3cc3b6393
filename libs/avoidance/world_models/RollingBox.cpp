#include "avoidance/world_models/RollingBox.h"

#include <hagen/avoidance/WorldModel.h>
#include <cmath>

namespace hagen::avoidance {

namespace {

constexpr float kSteepest = 0.25f;  ///< slope of the planners' steepest commands

/// The non-negative modulo.
int wrap(int value, int size) {
    const int rest = value % size;
    return rest < 0 ? rest + size : rest;
}

}  // namespace

Eigen::Vector3f rollingReachFor(const FlightPace& pace) {
    const float around_m = windowSizeFor(pace).radius_m;
    const float height_m = WorldModel::kReach_m + kSteepest * (around_m - WorldModel::kReach_m);
    return {around_m, around_m, height_m};
}

RollingBox::RollingBox(float edge_m, const Eigen::Vector3f& reach_m)
    : edge_m_(edge_m), per_edge_(1 / edge_m) {
    // The vehicle is up to half a block from the middle.
    const Eigen::Array3f blocks = 2 * reach_m.array() / (kBlock * edge_m) + 1;
    groups_ = (blocks / 4 - 1e-4f).ceil().cast<int>();
    size_ = groups_ * kGroup;
    fillParts();
}

void RollingBox::fillParts() {
    std::uint32_t stride = 64 * 64;
    for (int axis = 0; axis < 3; ++axis) {
        auto& parts = parts_[static_cast<std::size_t>(axis)];
        parts.resize(static_cast<std::size_t>(size_[axis]) + 2);
        for (int place = 0; place < size_[axis]; ++place) {
            const auto at = static_cast<std::uint32_t>(wrap(min_[axis] + place, size_[axis]));
            parts[static_cast<std::size_t>(place) + 1] = at / kGroup * stride +
                                                         ((at / kBlock % 4) << (6 + 2 * axis)) +
                                                         ((at % kBlock) << (2 * axis));
        }
        parts.front() = parts[1];
        parts.back() = parts[parts.size() - 2];
        stride *= static_cast<std::uint32_t>(groups_[axis]);
    }
}

const std::vector<std::uint32_t>& RollingBox::moveTo(const Eigen::Vector3f& vehicle_m) {
    left_.clear();
    const Eigen::Array3i was = min_;
    const Eigen::Array3f block = vehicle_m.array() * per_edge_ / kBlock;
    min_ = (block - (size_ / kBlock).cast<float>() / 2).round().cast<int>() * kBlock;
    if (is_placed_ && (min_ == was).all()) return left_;
    const bool is_first = !is_placed_;
    is_placed_ = true;
    fillParts();
    if (is_first) return left_;  // the box was empty
    // Positions along an axis that are new in the box.
    std::array<std::array<int, 2>, 3> entered;
    for (int axis = 0; axis < 3; ++axis) {
        const int moved = std::clamp(min_[axis] - was[axis], -size_[axis], size_[axis]);
        auto& [from, to] = entered[static_cast<std::size_t>(axis)];
        from = moved > 0 ? size_[axis] - moved : 0;
        to = moved > 0 ? size_[axis] : -moved;
    }
    const auto isNew = [&](std::size_t axis, int place) {
        return place >= entered[axis][0] && place < entered[axis][1];
    };
    for (int z = 0; z < size_.z(); z += kBlock) {
        for (int y = 0; y < size_.y(); y += kBlock) {
            const bool is_row_new = isNew(2, z) || isNew(1, y);
            const int from = is_row_new ? 0 : entered[0][0];
            const int to = is_row_new ? size_.x() : entered[0][1];
            for (int x = from; x < to; x += kBlock) left_.push_back(indexOf({x, y, z}) / 64);
        }
    }
    std::sort(left_.begin(), left_.end());
    return left_;
}

std::uint32_t RollingBox::groupPart(int axis, int group) const {
    int stride = 1;
    for (int before = 0; before < axis; ++before) stride *= groups_[before];
    return static_cast<std::uint32_t>(wrap(group, groups_[axis]) * stride);
}

Eigen::Array3i RollingBox::placeOf(std::uint32_t block) const {
    const auto group = static_cast<int>(block / 64), within = static_cast<int>(block % 64);
    const Eigen::Array3i of_group(group % groups_.x(), group / groups_.x() % groups_.y(),
                                  group / groups_.x() / groups_.y());
    const Eigen::Array3i stored =
        kGroup * of_group + kBlock * Eigen::Array3i(within % 4, within / 4 % 4, within / 16);
    Eigen::Array3i place;
    for (int axis = 0; axis < 3; ++axis) {
        place[axis] = wrap(stored[axis] - min_[axis], size_[axis]);
    }
    return place;
}

std::size_t RollingBox::bytes() const {
    std::size_t words = left_.capacity();
    for (const auto& parts : parts_) words += parts.capacity();
    return words * sizeof(std::uint32_t);
}

}  // namespace hagen::avoidance
