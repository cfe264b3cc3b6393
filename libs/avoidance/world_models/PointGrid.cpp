#include "avoidance/world_models/PointGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace hagen::avoidance {
namespace {

constexpr float kSlack_m = 1e-3f;  ///< for the rounding of cells; several kilometres have less
constexpr double kMaxCells = 1e6;
constexpr int kMaxRows = 8;  ///< on each side of a query's
/// Nanoflann compares distances with sums of up to some dozen rounded terms.
constexpr float kRounding = 1e-5f;

/// Four numbers at once.
using Four = float __attribute__((vector_size(16)));

Four fourFrom(const float* at) {
    Four four;
    std::memcpy(&four, at, sizeof four);
    return four;
}

}  // namespace

PointGrid::PointGrid(const std::vector<Eigen::Vector3f>& points_m, const Eigen::AlignedBox3f& box_m,
                     float limit_m)
    : box_m_(box_m), limit_m_(limit_m) {
    const Eigen::Vector3f margin_m = Eigen::Vector3f::Constant(limit_m + kSlack_m);
    const Eigen::AlignedBox3f reach_m(box_m.min() - margin_m, box_m.max() + margin_m);
    std::vector<Eigen::Vector3f> near_m;
    near_m.reserve(points_m.size());
    Eigen::AlignedBox3f occupied_m;
    for (const Eigen::Vector3f& point_m : points_m) {
        if (!reach_m.contains(point_m)) continue;
        near_m.push_back(point_m);
        occupied_m.extend(point_m);
    }
    if (near_m.empty()) return;
    corner_m_ = occupied_m.min();
    const auto cellsWith = [&](float edge_m) {
        return ((occupied_m.sizes() / edge_m).array().floor() + 1).cast<double>().prod();
    };
    while (cellsWith(edge_m_) > kMaxCells || limit_m_ + kSlack_m > kMaxRows * edge_m_) edge_m_ *= 2;
    size_ = (occupied_m.sizes() / edge_m_).cast<int>().array() + 1;
    sortPoints(near_m);
    listRows();
}

void PointGrid::sortPoints(const std::vector<Eigen::Vector3f>& points_m) {
    std::vector<std::uint32_t> cell_of;
    cell_of.reserve(points_m.size());
    begin_.assign(static_cast<std::size_t>(size_.prod()) + 1, 0);
    for (const Eigen::Vector3f& point_m : points_m) {
        const Eigen::Array3i at =
            ((point_m - corner_m_) / edge_m_).cast<int>().array().min(size_.array() - 1);
        const int cell = (at.z() * size_.y() + at.y()) * size_.x() + at.x();
        cell_of.push_back(static_cast<std::uint32_t>(cell));
        ++begin_[cell_of.back()];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& end : begin_) end = sum += end;
    // Four are read at once, so three more, which are far away, follow the last.
    for (auto& axis : at_m_) axis.resize(points_m.size() + 3, std::numeric_limits<float>::max());
    for (std::size_t i = points_m.size(); i-- > 0;) {
        const std::uint32_t place = --begin_[cell_of[i]];
        for (int axis = 0; axis < 3; ++axis) at_m_[axis][place] = points_m[i][axis];
    }
}

void PointGrid::listRows() {
    most_ = static_cast<int>(std::ceil((limit_m_ + kSlack_m) / edge_m_));
    const auto gap_m = [&](int cells) {
        return std::max(0.0f, static_cast<float>(std::abs(cells) - 1) * edge_m_ - kSlack_m);
    };
    for (int z = -most_; z <= most_; ++z) {
        for (int y = -most_; y <= most_; ++y) {
            const float min_m2 = gap_m(y) * gap_m(y) + gap_m(z) * gap_m(z);
            if (min_m2 <= limit_m_ * limit_m_) rows_.push_back({y, z, min_m2});
        }
    }
    std::sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) {
        const int cells2_of_a = a.y * a.y + a.z * a.z, cells2_of_b = b.y * b.y + b.z * b.z;
        return a.min_m2 != b.min_m2 ? a.min_m2 < b.min_m2 : cells2_of_a < cells2_of_b;
    });
}

float PointGrid::distanceToCell_m(float at_m, int cell, int axis) const {
    const float low_m = corner_m_[axis] + static_cast<float>(cell) * edge_m_;
    return std::max({0.0f, low_m - at_m - kSlack_m, at_m - low_m - edge_m_ - kSlack_m});
}

std::optional<float> PointGrid::minDistance_m2(const Eigen::Vector3f& point_m) const {
    if (!box_m_.contains(point_m)) return std::nullopt;
    float min_m2 = limit_m_ * limit_m_, relevant_m2 = min_m2 * (1 + kRounding);
    if (begin_.empty()) return min_m2;
    bool is_close = false;  // whether another distance is hardly more than the least
    const Eigen::Array3f in_cells = ((point_m - corner_m_) / edge_m_).array();
    const Eigen::Array3i at = in_cells.floor().cast<int>();
    std::array<float, 2 * kMaxRows + 1> to_y_m2, to_z_m2;
    for (int i = -most_; i <= most_; ++i) {
        const float y_m = distanceToCell_m(point_m.y(), at.y() + i, 1);
        const float z_m = distanceToCell_m(point_m.z(), at.z() + i, 2);
        to_y_m2[static_cast<std::size_t>(i + most_)] = y_m * y_m;
        to_z_m2[static_cast<std::size_t>(i + most_)] = z_m * z_m;
    }
    float reach_m2 = 0;  // within which cells of a row matter
    int first = 0, last = 0;
    for (const Row& row : rows_) {
        if (row.min_m2 > relevant_m2) break;
        const int y = at.y() + row.y, z = at.z() + row.z;
        if (y < 0 || z < 0 || y >= size_.y() || z >= size_.z()) continue;
        const float to_row_m2 = to_y_m2[static_cast<std::size_t>(row.y + most_)] +
                                to_z_m2[static_cast<std::size_t>(row.z + most_)];
        if (to_row_m2 > relevant_m2) continue;
        if (reach_m2 != relevant_m2) {
            reach_m2 = relevant_m2;
            const float reach = (std::sqrt(relevant_m2) + kSlack_m) / edge_m_;
            first = std::max(0, static_cast<int>(in_cells.x() - reach));
            last = std::min(size_.x() - 1, static_cast<int>(std::floor(in_cells.x() + reach)));
            if (first > last) break;
        }
        const std::uint32_t* begin =
            &begin_[static_cast<std::size_t>((z * size_.y() + y) * size_.x())];
        for (std::uint32_t i = begin[first], end = begin[last + 1]; i < end; i += 4) {
            // Summed up in nanoflann's order. Points of the cells that follow do no harm.
            const Four x4 = point_m.x() - fourFrom(&at_m_[0][i]);
            const Four y4 = point_m.y() - fourFrom(&at_m_[1][i]);
            const Four z4 = point_m.z() - fourFrom(&at_m_[2][i]);
            const Four distances_m2 = x4 * x4 + y4 * y4 + z4 * z4;
            const auto is_relevant = distances_m2 <= relevant_m2;
            std::uint64_t halves[2];
            std::memcpy(halves, &is_relevant, sizeof halves);
            if ((halves[0] | halves[1]) == 0) continue;
            for (int lane = 0; lane < 4; ++lane) {
                const float distance_m2 = distances_m2[lane];
                if (!(distance_m2 <= relevant_m2) || distance_m2 == min_m2) continue;
                if (distance_m2 > min_m2) {
                    is_close = true;
                    continue;
                }
                is_close = min_m2 <= distance_m2 * (1 + kRounding);
                min_m2 = distance_m2;
                relevant_m2 = min_m2 * (1 + kRounding);
            }
        }
    }
    if (is_close) return std::nullopt;
    return min_m2;
}

}  // namespace hagen::avoidance
