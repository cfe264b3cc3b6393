#include "MotionWindow.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace hagen::avoidance {
namespace {

// What may be wrong with a velocity, as a share of it (a turn is not foreseen) and as a share of
// its standard deviation.
constexpr float kDoubtOfSpeed = 0.1f, kDoubtOfSigma = 0.5f;

}  // namespace

void MotionWindow::update(const mapping::MappedScan& scan) {
    const auto view = std::make_shared<const View>(viewOf(scan));
    tracks_.update(scan, view);
    window_.update(scan, view, tracks_.trackOfObstacle());
    movers_.clear();
    fastest_m_s_ = 0;
    std::vector<std::uint32_t> moving;
    for (const ObstacleTrack& track : tracks_.tracks()) {
        if (!track.is_moving) continue;
        moving.push_back(track.number);
        const Eigen::Vector2f level_m_s = track.velocity_m_s.cast<float>();
        Mover mover;
        mover.velocity_m_s << level_m_s, 0;
        const auto since_s = static_cast<float>(scan.time_s - track.sights.front().time_s);
        mover.middle_m.setZero();
        for (const Eigen::Vector3f& point_m : track.sights.front().points_m) {
            mover.points_m.push_back(point_m + since_s * mover.velocity_m_s);
            mover.middle_m += mover.points_m.back();
        }
        mover.middle_m /= static_cast<float>(mover.points_m.size());
        mover.radius_m = 0;
        for (const Eigen::Vector3f& point_m : mover.points_m) {
            mover.radius_m = std::max(mover.radius_m, (point_m - mover.middle_m).norm());
        }
        mover.doubt_m_s = kDoubtOfSpeed * level_m_s.norm() +
                          kDoubtOfSigma * static_cast<float>(track.velocitySigma_m_s());
        mover.doubt_m = since_s * mover.doubt_m_s;
        fastest_m_s_ = std::max(fastest_m_s_, level_m_s.norm() + mover.doubt_m_s);
        movers_.push_back(std::move(mover));
    }
    window_.hide(moving);
}

float MotionWindow::moversWithin_m(const Eigen::Vector3f& point_m, float after_s,
                                   float limit_m) const {
    float least_m = limit_m;
    for (const Mover& mover : movers_) {
        const Eigen::Vector3f at_m = point_m - after_s * mover.velocity_m_s;
        const float doubt_m = mover.doubt_m + after_s * mover.doubt_m_s;
        if ((at_m - mover.middle_m).norm() - mover.radius_m - doubt_m >= least_m) continue;
        float least_m2 = std::numeric_limits<float>::infinity();
        for (const Eigen::Vector3f& of_mover_m : mover.points_m) {
            least_m2 = std::min(least_m2, (of_mover_m - at_m).squaredNorm());
        }
        least_m = std::min(least_m, std::max(0.0f, std::sqrt(least_m2) - doubt_m));
    }
    return least_m;
}

float MotionWindow::clearance_m(const Eigen::Vector3f& point_m) const {
    return clearanceWithin_m(point_m, kReach_m);
}

float MotionWindow::clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const {
    return moversWithin_m(point_m, 0, window_.clearanceWithin_m(point_m, limit_m));
}

float MotionWindow::clearanceAfter_m(const Eigen::Vector3f& point_m, double after_s) const {
    return moversWithin_m(point_m, static_cast<float>(after_s), window_.clearance_m(point_m));
}

std::size_t MotionWindow::bytes() const {
    std::size_t bytes = sizeof(*this) + window_.bytes() + tracks_.bytes();
    for (const Mover& mover : movers_) {
        bytes += sizeof(mover) + mover.points_m.capacity() * sizeof(Eigen::Vector3f);
    }
    return bytes;
}

WorldModel::Obstacles MotionWindow::obstacles() const {
    Obstacles obstacles = window_.obstacles();
    for (const Mover& mover : movers_) {
        obstacles.centre_m.insert(obstacles.centre_m.end(), mover.points_m.begin(),
                                  mover.points_m.end());
    }
    return obstacles;
}

}  // namespace hagen::avoidance
