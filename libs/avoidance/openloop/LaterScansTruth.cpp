#include "avoidance/openloop/LaterScansTruth.h"
#include <algorithm>
#include <cmath>
#include <iterator>

namespace hagen::avoidance {
namespace {

constexpr float kVehicleRadius_m = 1.0f;  // space this close to the vehicle is free
constexpr float kPersistenceRange_m = 12, kCell_m = 0.3f;
constexpr std::size_t kPersistenceScans = 5;
constexpr std::uint8_t kPointsToBlock = 2;
constexpr float kPi_rad = static_cast<float>(M_PI);

float distanceToPath(const Eigen::Vector3f& point_m, const Eigen::Vector3f& direction,
                     float length_m) {
    const float along_m = std::clamp(point_m.dot(direction), 0.0f, length_m);
    return (point_m - along_m * direction).norm();
}

/// Packs 21 bits per axis, enough for 600 km.
std::uint64_t cellNumber(const Eigen::Array3i& cell) {
    constexpr std::uint64_t kMiddle = 1u << 20, kMask = (1u << 21) - 1;
    std::uint64_t number = 0;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        number = number << 21 | ((static_cast<std::uint64_t>(cell[axis]) + kMiddle) & kMask);
    }
    return number;
}

Eigen::Array3i cellOf(const Eigen::Vector3f& point_m) {
    return (point_m.array() / kCell_m).floor().cast<int>();
}

}  // namespace

std::vector<Eigen::Vector3f> PersistentPoints::of(const observations::MappedScan& next) {
    const auto lasts = [&](const Eigen::Array3i& cell) {
        for (int i = 0; i < 27; ++i) {
            const Eigen::Array3i beside = cell + Eigen::Array3i(i % 3, i / 3 % 3, i / 9) - 1;
            const auto before = last_scan_.find(cellNumber(beside));
            if (before != last_scan_.end() && before->second + kPersistenceScans >= scans_)
                return true;
        }
        return false;
    };
    std::vector<Eigen::Vector3f> lasting;
    std::unordered_map<std::uint64_t, bool>
        cells;  // cells of this scan, and whether they are persistent
    for (const Eigen::Vector3f& point_m : next.points_m) {
        if ((point_m - next.origin_m).norm() > kPersistenceRange_m) continue;
        const Eigen::Array3i cell = cellOf(point_m);
        const auto [entry, is_new] = cells.try_emplace(cellNumber(cell), false);
        if (is_new) entry->second = lasts(cell);
        if (entry->second) lasting.push_back(point_m);
    }
    for (const auto& [cell, is_lasting] : cells) last_scan_[cell] = scans_;
    ++scans_;
    for (auto cell = last_scan_.begin(); scans_ % 100 == 0 && cell != last_scan_.end();) {
        cell = cell->second + kPersistenceScans < scans_ ? last_scan_.erase(cell) : std::next(cell);
    }
    return lasting;
}

SeenRanges::SeenRanges(const observations::MappedScan& scan)
    : origin_m_(scan.origin_m), farthest_m_(kAzimuths * kElevations, 0.0f) {
    for (const Eigen::Vector3f& point_m : scan.points_m) {
        const Eigen::Vector3f from_origin_m = point_m - origin_m_;
        const float range_m = from_origin_m.norm();
        if (range_m <= 0) continue;
        float& farthest_m = farthest_m_[cellOf(from_origin_m, range_m)];
        farthest_m = std::max(farthest_m, range_m);
    }
}

std::size_t SeenRanges::cellOf(const Eigen::Vector3f& from_origin_m, float range_m) {
    const float azimuth = std::atan2(from_origin_m.y(), from_origin_m.x()) / (2 * kPi_rad) + 0.5f;
    const float sine = std::clamp(from_origin_m.z() / range_m, -1.0f, 1.0f);
    const float elevation = std::asin(sine) / kPi_rad + 0.5f;
    const int column = std::min(static_cast<int>(azimuth * kAzimuths), kAzimuths - 1);
    const int row = std::min(static_cast<int>(elevation * kElevations), kElevations - 1);
    return static_cast<std::size_t>(row * kAzimuths + column);
}

bool SeenRanges::isSeenThrough(const Eigen::Vector3f& point_m) const {
    const Eigen::Vector3f from_origin_m = point_m - origin_m_;
    const float range_m = from_origin_m.norm();
    return range_m < kVehicleRadius_m || farthest_m_[cellOf(from_origin_m, range_m)] > range_m;
}

LaterScansTruth::LaterScansTruth(const Eigen::Vector3f& position_m,
                                 const FreeDirectionOptions& options)
    : position_m_(position_m), options_(options) {}

/// Considers only azimuths within the point's sphere.
void LaterScansTruth::addPoint(const Eigen::Vector3f& from_here_m) {
    const float flat_m = from_here_m.head<2>().norm();
    int half = kDirectionAzimuths / 2;
    if (flat_m > options_.clearance_radius_m) {
        const float share = std::asin(options_.clearance_radius_m / flat_m) / (2 * kPi_rad);
        half = std::min(half, 1 + static_cast<int>(share * kDirectionAzimuths));
    }
    const float turn = std::atan2(from_here_m.y(), from_here_m.x()) / (2 * kPi_rad);
    const int nearest = static_cast<int>(std::lround(turn * kDirectionAzimuths));
    for (int step = -half; step <= half; ++step) {
        const auto azimuth = static_cast<std::size_t>((nearest + step + 2 * kDirectionAzimuths) %
                                                      kDirectionAzimuths);
        if (step == half && 2 * half == kDirectionAzimuths) break;  // the same azimuth as the first
        for (std::size_t n = azimuth; n < kDirections; n += kDirectionAzimuths) {
            if (points_[n] == kPointsToBlock) continue;
            const float off_m = distanceToPath(from_here_m, directionOf(n), options_.length_m);
            if (off_m < options_.clearance_radius_m) ++points_[n];
        }
    }
}

void LaterScansTruth::see(const std::vector<Eigen::Vector3f>& persistent_m,
                          const SeenRanges& ranges) {
    const float reach_m = options_.length_m + options_.clearance_radius_m;
    const float reach_up_m = options_.length_m * std::sin(static_cast<float>(kMaxElevation_rad)) +
                             options_.clearance_radius_m;
    for (const Eigen::Vector3f& point_m : persistent_m) {
        const Eigen::Vector3f from_here_m = point_m - position_m_;
        if (std::abs(from_here_m.z()) > reach_up_m) continue;
        if (from_here_m.squaredNorm() > reach_m * reach_m) continue;
        addPoint(from_here_m);
    }
    for (std::size_t n = 0; n < kDirections; ++n) {
        for (std::size_t s = 0; s < kSamples; ++s) {
            if (seen_[n][s]) continue;
            const float distance_m = options_.length_m * static_cast<float>(s + 1) / kSamples;
            seen_[n][s] = ranges.isSeenThrough(position_m_ + distance_m * directionOf(n));
        }
    }
}

TrueDirections LaterScansTruth::directions() const {
    TrueDirections truth;
    for (std::size_t n = 0; n < kDirections; ++n) {
        truth.blocked[n] = points_[n] == kPointsToBlock;
        truth.scored[n] = truth.blocked[n] || (points_[n] == 0 && seen_[n].all());
    }
    return truth;
}

}  // namespace hagen::avoidance
