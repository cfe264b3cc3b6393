#pragma once
#include <hagen/avoidance/FreeDirections.h>
#include <hagen/mrpt/MappedScan.h>
#include <Eigen/Core>
#include <array>
#include <bitset>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace hagen::avoidance {

/// Ground truth of the directions around a position, where known.
struct TrueDirections {
    DirectionSet blocked;  ///< subset of `scored`
    DirectionSet scored;   ///< directions with known truth
};

/// The maximum range of a scan in cells of 2 degrees around its origin, along the map's axes.
class SeenRanges {
 public:
    explicit SeenRanges(const observations::MappedScan& scan);
    /// Whether a return in the point's cell came from behind the point.
    bool isSeenThrough(const Eigen::Vector3f& point_m) const;

 private:
    static constexpr int kAzimuths = 180, kElevations = 90;
    static std::size_t cellOf(const Eigen::Vector3f& from_origin_m, float range_m);

    Eigen::Vector3f origin_m_;
    std::vector<float> farthest_m_;  ///< 0: no return
};

/// Selects the persistent points of a scan: in one of the five previous scans, the same cell of 0.3
/// m or an adjacent one contained a point. Dust and mixed ranges at edges are not persistent.
class PersistentPoints {
 public:
    /// Considers only points within 12 m of the sensor.
    std::vector<Eigen::Vector3f> of(const observations::MappedScan& next);

 private:
    std::unordered_map<std::uint64_t, std::size_t>
        last_scan_;  ///< the last scan with a point, by cell
    std::size_t scans_ = 0;
};

/// Ground truth at a position of a recorded flight without a known scene: the raw points of later
/// scans, regardless of the filter, at the poses of the log.
///
/// A direction is blocked if at least two persistent later points lie within the sphere's path. It
/// is free if none does and later returns came from behind the path's centre line at every half
/// metre. Otherwise it is not scored.
class LaterScansTruth {
 public:
    static constexpr double kDuration_s = 2.5;  ///< maximum age of later scans

    explicit LaterScansTruth(const Eigen::Vector3f& position_m,
                             const FreeDirectionOptions& options = {});

    void see(const std::vector<Eigen::Vector3f>& persistent_m, const SeenRanges& ranges);
    TrueDirections directions() const;

 private:
    static constexpr std::size_t kSamples = 16;  ///< along a path

    void addPoint(const Eigen::Vector3f& from_here_m);

    Eigen::Vector3f position_m_;
    FreeDirectionOptions options_;
    std::array<std::uint8_t, kDirections> points_{};  ///< points in the sphere's path, at most 2
    std::array<std::bitset<kSamples>, kDirections> seen_;
};

}  // namespace hagen::avoidance
