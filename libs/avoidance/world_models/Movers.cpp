#include "avoidance/world_models/Movers.h"
#include <algorithm>
#include <cmath>

#include "avoidance/world_models/Nearest.h"

namespace hagen::avoidance {
namespace {

// Velocity error as a fraction of the speed (turns are not predicted) and of its standard
// deviation.
constexpr float kDoubtOfSpeed = 0.1f, kDoubtOfSigma = 0.5f;

}  // namespace

struct Movers::Mover {
    Mover(const ObstacleTrack& track, double time_s);

    TreePoints points;  ///< positions at the time of the last scan
    PointTree tree;
    Eigen::Vector3f middle_m{0, 0, 0};
    float radius_m = 0;  ///< bounding sphere of the points
    Eigen::Vector3f velocity_m_s;
    float doubt_m, doubt_m_s;  ///< clearance uncertainty, initially and per second
};

Movers::Mover::Mover(const ObstacleTrack& track, double time_s) : tree(3, points) {
    const Eigen::Vector2f level_m_s = track.velocity_m_s.cast<float>();
    const auto since_s = static_cast<float>(time_s - track.sights.front().time_s);
    velocity_m_s << level_m_s, 0;
    for (const Eigen::Vector3f& point_m : track.sights.front().points_m) {
        points.at_m.push_back(point_m + since_s * velocity_m_s);
        middle_m += points.at_m.back();
    }
    middle_m /= static_cast<float>(points.at_m.size());
    for (const Eigen::Vector3f& point_m : points.at_m) {
        radius_m = std::max(radius_m, (point_m - middle_m).norm());
    }
    doubt_m_s = kDoubtOfSpeed * level_m_s.norm() +
                kDoubtOfSigma * static_cast<float>(track.velocitySigma_m_s());
    doubt_m = since_s * doubt_m_s;
    tree.buildIndex();
}

Movers::Movers(float farthest_m) : tracks_(farthest_m) {}
Movers::~Movers() = default;

void Movers::update(const observations::MappedScan& scan, const std::shared_ptr<const View>& view) {
    tracks_.update(scan, view);
    movers_.clear();
    moving_.clear();
    fastest_m_s_ = 0;
    for (const ObstacleTrack& track : tracks_.tracks()) {
        if (!track.is_moving) continue;
        moving_.push_back(track.number);
        movers_.push_back(std::make_unique<Mover>(track, scan.time_s));
        const Mover& mover = *movers_.back();
        fastest_m_s_ =
            std::max(fastest_m_s_, mover.velocity_m_s.head<2>().norm() + mover.doubt_m_s);
    }
}

float Movers::clearanceWithin_m(const Eigen::Vector3f& point_m, float after_s,
                                float limit_m) const {
    float min_m = limit_m;
    for (const auto& mover : movers_) {
        const Eigen::Vector3f at_m = point_m - after_s * mover->velocity_m_s;
        const float doubt_m = mover->doubt_m + after_s * mover->doubt_m_s;
        if ((at_m - mover->middle_m).norm() - mover->radius_m - doubt_m >= min_m) continue;
        Nearest nearest(min_m + doubt_m);
        mover->tree.findNeighbors(nearest, at_m.data(), {});
        min_m = std::min(min_m, std::max(0.0f, std::sqrt(nearest.worstDist()) - doubt_m));
    }
    return min_m;
}

std::size_t Movers::bytes() const {
    std::size_t bytes = sizeof(*this) + tracks_.bytes();
    for (const auto& mover : movers_) {
        bytes += sizeof(Mover) + mover->points.at_m.capacity() * sizeof(Eigen::Vector3f) +
                 mover->tree.usedMemory(mover->tree);
    }
    return bytes;
}

void Movers::addTo(WorldModel::Obstacles& obstacles) const {
    for (const auto& mover : movers_) {
        const std::vector<Eigen::Vector3f>& points_m = mover->points.at_m;
        obstacles.centre_m.insert(obstacles.centre_m.end(), points_m.begin(), points_m.end());
    }
}

}  // namespace hagen::avoidance
