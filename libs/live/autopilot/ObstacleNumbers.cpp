#include "live/autopilot/ObstacleNumbers.h"

#include <algorithm>
#include <limits>

namespace hagen::live {
namespace {

constexpr float kGap_m = 1, kSame_m = 1.5f;
constexpr std::uint16_t kUnknown = std::numeric_limits<std::uint16_t>::max();

bool isObstacle(const Direction& direction) { return direction.state == DirectionState::Obstacle; }

/// The nearest point of each run of directions with the same obstacle.
std::vector<Obstacle> obstaclesOf(const Directions& directions) {
    const std::size_t size = directions.size();
    const auto goesOn = [&](std::size_t k) {  // same obstacle as in the previous direction
        const Direction& before = directions[(k + size - 1) % size];
        const Direction& here = directions[k];
        return isObstacle(before) && isObstacle(here) && (before.at_m - here.at_m).norm() < kGap_m;
    };
    std::size_t begin = 0;  // start of a run, unless a run spans the full circle
    while (begin < size && goesOn(begin)) ++begin;
    std::vector<Obstacle> obstacles;
    float nearest_m = 0;
    for (std::size_t i = 0; i < size; ++i) {
        const std::size_t k = (begin + i) % size;
        if (!isObstacle(directions[k])) continue;
        const float distance_m = directions[k].distance_m;
        if (i > 0 && goesOn(k)) {
            if (distance_m >= nearest_m) continue;
            obstacles.back().at_m = directions[k].at_m;
        } else {
            obstacles.push_back({kUnknown, directions[k].at_m});
        }
        nearest_m = distance_m;
    }
    std::stable_sort(obstacles.begin(), obstacles.end(), [](const auto& a, const auto& b) {
        return a.at_m.template head<2>().norm() < b.at_m.template head<2>().norm();
    });
    return obstacles;
}

}  // namespace

std::vector<Obstacle> ObstacleNumbers::nearest(const Directions& directions, std::size_t max,
                                               const std::optional<VehiclePose>& pose) {
    std::vector<Obstacle> obstacles = obstaclesOf(directions);
    if (last_pose_ && pose) {
        const Eigen::Isometry3f move = levelBetween(*last_pose_, *pose).cast<float>();
        for (Obstacle& obstacle : last_) obstacle.at_m = move * obstacle.at_m;
    }
    for (Obstacle& obstacle : obstacles) {
        const auto distance_m = [&](const Obstacle& other) {
            return (other.at_m - obstacle.at_m).norm();
        };
        const auto same = std::min_element(
            last_.begin(), last_.end(),
            [&](const auto& a, const auto& b) { return distance_m(a) < distance_m(b); });
        if (same != last_.end() && distance_m(*same) < kSame_m) {
            obstacle.number = same->number;
            last_.erase(same);
        } else {
            obstacle.number = next_;
            next_ = static_cast<std::uint16_t>((next_ + 1) % kUnknown);
        }
    }
    last_ = obstacles;
    last_pose_ = pose;
    obstacles.resize(std::min(obstacles.size(), max));
    return obstacles;
}

}  // namespace hagen::live
