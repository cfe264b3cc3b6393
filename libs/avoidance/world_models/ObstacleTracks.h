#pragma once
#include <hagen/mrpt/MappedScan.h>
#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>
#include "avoidance/world_models/SeenDirections.h"

namespace hagen::avoidance {

/// An obstacle that is followed from scan to scan.
struct ObstacleTrack {
    /// Its points in one scan.
    struct Sight {
        double time_s;                          ///< mean time of its returns
        std::vector<Eigen::Vector3f> points_m;  ///< one per 10 cm cube
    };

    std::uint32_t number;                      ///< from 1; no later track has it
    Eigen::Vector2d at_m, velocity_m_s{0, 0};  ///< of its middle seen from above
    Eigen::Matrix2d covariance;                ///< of place and velocity, the same along x and y
    double time_s;                             ///< of the state
    int seen_scans = 1, missed_scans = 0;      ///< missed: since the last that it was seen in
    bool crossed_free_space = false;           ///< once; then it can move
    bool is_moving = false;
    std::deque<Sight> sights;  ///< newest first, of 0.6 s

    /// Standard deviation of the velocity along each axis.
    double velocitySigma_m_s() const;
};

/// Velocities of the obstacles that the filter numbers: nearest neighbours are matched from scan to
/// scan, and a Kalman filter with constant velocity (per axis, in the plane) follows each.
///
/// An obstacle counts as moving if it is fast: seen in three scans or more, and faster than 0.5 m/s
/// and three standard deviations of its speed. To begin with,
/// - its points of up to 0.6 s ago, moved along at its velocity, must fit its points of now clearly
///   better than where they were (the visible part of a standing obstacle changes as the vehicle
///   passes, which moves its middle, but not its points);
/// - it must cross free space: the scan of up to 0.6 s ago saw farther at a tenth of its points, or
///   the scan of now does so where they were then. A standing obstacle whose visible part changes
///   does not. Rays pass a wire on both sides, so that pieces of one seem to move along it: what is
///   less than 15 cm high needs both.
/// After that, it moves whenever it is fast: close by, the visible part of a mover changes, too.
///
/// A track that is not seen for ten scans ends. Obstacles wider than 6 m, with less than three
/// points, or with a point that is too far away are not followed.
class ObstacleTracks {
 public:
    explicit ObstacleTracks(float farthest_m = 25) : farthest_m_(farthest_m) {}

    /// Takes in the next scan; its `obstacles` must be numbered.
    void update(const observations::MappedScan& scan);
    /// The same for a scan whose view (viewOf()) is at hand.
    void update(const observations::MappedScan& scan, std::shared_ptr<const View> view);

    const std::vector<ObstacleTrack>& tracks() const { return tracks_; }
    /// The number of the track that each obstacle of the last scan belongs to, by the obstacle's
    /// number; 0: none.
    const std::vector<std::uint32_t>& trackOfObstacle() const { return track_of_obstacle_; }
    /// Memory, without the views, which are shared.
    std::size_t bytes() const;

 private:
    float farthest_m_;
    std::deque<std::shared_ptr<const View>> views_;  ///< newest first
    std::vector<ObstacleTrack> tracks_;
    std::vector<std::uint32_t> track_of_obstacle_;
    std::uint32_t tracks_begun_ = 0;
};

}  // namespace hagen::avoidance
