#pragma once
#include <hagen/avoidance/ObstacleTracks.h>
#include "WindowModel.h"

namespace hagen::avoidance {

/// A window of RoI points in which obstacles that move are where they will be: the points of the
/// last scan that saw one, moved along at its velocity. Its older points, where it no longer is, do
/// not count while it is followed and moves; then they do again, for where it went is not known.
/// What does not move, or not certainly, is as in the window.
class MotionWindow : public WorldModel {
 public:
    explicit MotionWindow(WindowSize size) : window_(true, size), tracks_(size.radius_m) {}

    void update(const mapping::MappedScan& scan) override;
    float clearance_m(const Eigen::Vector3f& point_m) const override;
    float clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const override;
    float clearanceAfter_m(const Eigen::Vector3f& point_m, double after_s) const override;
    float fastest_m_s() const override { return fastest_m_s_; }
    bool isKnown(const Eigen::Vector3f& point_m) const override { return window_.isKnown(point_m); }
    std::size_t bytes() const override;
    Obstacles obstacles() const override;

 private:
    /// An obstacle that moves.
    struct Mover {
        std::vector<Eigen::Vector3f> points_m;  ///< at the time of the last scan
        Eigen::Vector3f middle_m;
        float radius_m;  ///< of a sphere around the points
        Eigen::Vector3f velocity_m_s;
        float doubt_m, doubt_m_s;  ///< clearance that is not certain, at once and per second
    };
    float moversWithin_m(const Eigen::Vector3f& point_m, float after_s, float limit_m) const;

    WindowModel window_;
    ObstacleTracks tracks_;
    std::vector<Mover> movers_;
    float fastest_m_s_ = 0;
};

}  // namespace hagen::avoidance
