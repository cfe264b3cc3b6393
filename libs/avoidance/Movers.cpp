#include "Movers.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace hagen::avoidance {
namespace {

// What may be wrong with a velocity, as a share of it (a turn is not foreseen) and as a share of
// its standard deviation.
constexpr float kDoubtOfSpeed = 0.1f, kDoubtOfSigma = 0.5f;

}  // namespace

Movers::Mover Movers::moverFrom(const ObstacleTrack& track, double time_s) {
    const Eigen::Vector2f level_m_s = track.velocity_m_s.cast<float>();
    const auto since_s = static_cast<float>(time_s - track.sights.front().time_s);
    Mover mover;
    mover.velocity_m_s << level_m_s, 0;
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
    return mover;
}

void Movers::update(const mapping::MappedScan& scan, const std::shared_ptr<const View>& view) {
    tracks_.update(scan, view);
    movers_.clear();
    moving_.clear();
    fastest_m_s_ = 0;
    for (const ObstacleTrack& track : tracks_.tracks()) {
        if (!track.is_moving) continue;
        moving_.push_back(track.number);
        movers_.push_back(moverFrom(track, scan.time_s));
        const Mover& mover = movers_.back();
        fastest_m_s_ =
            std::max(fastest_m_s_, mover.velocity_m_s.head<2>().norm() + mover.doubt_m_s);
    }
}

float Movers::clearanceWithin_m(const Eigen::Vector3f& point_m, float after_s,
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

std::size_t Movers::bytes() const {
    std::size_t bytes = sizeof(*this) + tracks_.bytes();
    for (const Mover& mover : movers_) {
        bytes += sizeof(mover) + mover.points_m.capacity() * sizeof(Eigen::Vector3f);
    }
    return bytes;
}

void Movers::addTo(WorldModel::Obstacles& obstacles) const {
    for (const Mover& mover : movers_) {
        obstacles.centre_m.insert(obstacles.centre_m.end(), mover.points_m.begin(),
                                  mover.points_m.end());
    }
}

}  // namespace hagen::avoidance
