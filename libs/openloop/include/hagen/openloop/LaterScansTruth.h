#pragma once
#include <hagen/mapping/MappedScan.h>
#include <hagen/openloop/FreeDirections.h>
#include <Eigen/Core>
#include <array>
#include <bitset>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace hagen::openloop {

/// What is true of the directions around a place, as far as it is known.
struct TrueDirections {
    DirectionSet blocked;  ///< within `scored`
    DirectionSet scored;   ///< of these the truth is known
};

/// How far a scan saw, in cells of 2 degrees around its origin, by the map's axes.
class SeenRanges {
 public:
    explicit SeenRanges(const mapping::MappedScan& scan);
    /// Whether a return came from behind a point, from its cell.
    bool isSeenThrough(const Eigen::Vector3f& point_m) const;

 private:
    static constexpr int kAzimuths = 180, kElevations = 90;
    static std::size_t cellOf(const Eigen::Vector3f& from_origin_m, float range_m);

    Eigen::Vector3f origin_m_;
    std::vector<float> farthest_m_;  ///< 0: no return
};

/// Which points of a scan last: near them (in the same cell of 0.3 m, or one beside it) one of the
/// five scans before had a point, too. Specks of dust, and ranges between two things, do not.
class LastingPoints {
 public:
    /// Of the points within 12 m of the sensor.
    std::vector<Eigen::Vector3f> of(const mapping::MappedScan& next);

 private:
    std::unordered_map<std::uint64_t, std::size_t> last_scan_;  ///< that had a point in a cell
    std::size_t scans_ = 0;
};

/// The truth about a place in a recorded flight, of which no scene is known: the raw points of the
/// scans that came after, whatever the filter says of them, at the poses of the log.
///
/// A direction is blocked where two later points or more, of those that last, lie within the room
/// of the way; it is free where none does, and later returns came from behind the way's middle line
/// at every half metre; else it is not scored.
class LaterScansTruth {
 public:
    static constexpr double kDuration_s = 2.5;  ///< scans up to so much later are to be seen

    explicit LaterScansTruth(const Eigen::Vector3f& position_m,
                             const FreeDirectionOptions& options = {});

    void see(const std::vector<Eigen::Vector3f>& lasting_m, const SeenRanges& ranges);
    TrueDirections directions() const;

 private:
    static constexpr std::size_t kSamples = 16;  ///< along a way

    void seePoint(const Eigen::Vector3f& from_here_m);

    Eigen::Vector3f position_m_;
    FreeDirectionOptions options_;
    std::array<std::uint8_t, kDirections> points_{};  ///< within the room of the way, 2 at most
    std::array<std::bitset<kSamples>, kDirections> seen_;
};

}  // namespace hagen::openloop
