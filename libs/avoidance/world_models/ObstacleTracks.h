#pragma once
#include <hagen/mrpt/MappedScan.h>
#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>
#include "avoidance/world_models/SeenDirections.h"

namespace hagen::avoidance {

/// An obstacle tracked from scan to scan.
struct ObstacleTrack {
    /// The obstacle's points in one scan.
    struct Sight {
        double time_s;                          ///< mean time of its returns
        std::vector<Eigen::Vector3f> points_m;  ///< one per 10 cm cube
    };

    std::uint32_t number;                      ///< starts at 1; never reused
    Eigen::Vector2d at_m, velocity_m_s{0, 0};  ///< state of its centre seen from above
    Eigen::Matrix2d covariance;  ///< covariance of position and velocity, the same for x and y
    double time_s;               ///< time of the state
    int seen_scans = 1, missed_scans = 0;  ///< missed: since the last sighting
    bool crossed_free_space = false;       ///< required of moving obstacles
    bool is_moving = false;
    std::deque<Sight> sights;  ///< from the last 0.6 s, newest first

    /// Standard deviation of the velocity along each axis.
    double velocitySigma_m_s() const;
};

/// Velocities of the obstacles numbered by the filter: matches nearest neighbours from scan to
/// scan, and tracks each with a constant-velocity Kalman filter (per axis, in the plane).
///
/// An obstacle is fast if seen in at least three scans, and faster than 0.5 m/s and three standard
/// deviations of its speed. A fast obstacle is first classified as moving if
/// - its points of up to 0.6 s ago, moved with its velocity, fit its current points clearly better
///   than unmoved (the visible part of a static obstacle changes, but not its points), and
/// - it crosses free space: the scan of up to 0.6 s ago saw farther at a tenth of its points, or
///   the current scan does so at its former points. Parts of a wire seem to move along it, so
///   obstacles less than 15 cm high need both scans.
/// Afterwards, it is moving whenever it is fast.
///
/// A track not seen for ten scans ends. Obstacles wider than 6 m, with fewer than three points, or
/// with a point that is too far away are not tracked.
class ObstacleTracks {
 public:
    explicit ObstacleTracks(float farthest_m = 25) : farthest_m_(farthest_m) {}

    /// Adds the next scan; its `obstacles` must be numbered.
    void update(const observations::MappedScan& scan);
    /// Like update(scan), but with the scan's view (viewOf()).
    void update(const observations::MappedScan& scan, std::shared_ptr<const View> view);

    const std::vector<ObstacleTrack>& tracks() const { return tracks_; }
    /// The track number of each obstacle of the last scan, by obstacle number; 0: none.
    const std::vector<std::uint32_t>& trackOfObstacle() const { return track_of_obstacle_; }
    /// Memory in bytes, without the shared views.
    std::size_t bytes() const;

 private:
    float farthest_m_;
    std::deque<std::shared_ptr<const View>> views_;  ///< newest first
    std::vector<ObstacleTrack> tracks_;
    std::vector<std::uint32_t> track_of_obstacle_;
    std::uint32_t tracks_begun_ = 0;
};

}  // namespace hagen::avoidance
