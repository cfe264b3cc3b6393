#include "avoidance/world_models/ModelsWithMotion.h"
#include <algorithm>

namespace hagen::avoidance {
namespace {

constexpr float kBefore_m = 0.2f;  // one cell

/// Removes obstacles but keeps the rays up to them, which clear earlier obstacles in between.
observations::MappedScan withoutObstacles(const observations::MappedScan& scan,
                                          const std::vector<bool>& is_left_out) {
    observations::MappedScan rest;
    rest.time_s = scan.time_s;
    rest.origin_m = scan.origin_m;
    for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
        const auto obstacle = static_cast<std::size_t>(scan.obstacles[i]);
        if (obstacle < is_left_out.size() && is_left_out[obstacle]) {
            const Eigen::Vector3f ray = scan.points_m[i] - rest.origin_m;
            const float range_m = ray.norm();
            if (range_m > kBefore_m) {
                rest.passed_to_m.push_back(rest.origin_m + ray * (1 - kBefore_m / range_m));
            }
            continue;
        }
        rest.points_m.push_back(scan.points_m[i]);
        rest.labels.push_back(scan.labels[i]);
        rest.obstacles.push_back(scan.obstacles[i]);
        if (!scan.age_s.empty()) rest.age_s.push_back(scan.age_s[i]);
    }
    return rest;
}

}  // namespace

float ModelWithMotion::clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const {
    return movers_.clearanceWithin_m(point_m, 0, still_->clearanceWithin_m(point_m, limit_m));
}

float ModelWithMotion::clearanceAfter_m(const Eigen::Vector3f& point_m, double after_s) const {
    return movers_.clearanceWithin_m(point_m, static_cast<float>(after_s),
                                     still_->clearance_m(point_m));
}

WorldModel::Obstacles ModelWithMotion::obstacles() const {
    Obstacles obstacles = still_->obstacles();
    movers_.addTo(obstacles);
    return obstacles;
}

void WindowWithMotion::update(const observations::MappedScan& scan) {
    const auto view = std::make_shared<const View>(viewOf(scan));
    movers_.update(scan, view);
    auto& window = static_cast<WindowModel&>(*still_);
    window.update(scan, view, movers_.tracks().trackOfObstacle());
    window.hide(movers_.moving());
}

void MapWithMotion::update(const observations::MappedScan& scan) {
    movers_.update(scan, std::make_shared<const View>(viewOf(scan)));
    const std::vector<std::uint32_t>&moving = movers_.moving(),
          &track_of = movers_.tracks().trackOfObstacle();
    if (moving.empty() || scan.obstacles.empty()) return still_->update(scan);
    std::vector<bool> is_moving(track_of.size());
    for (std::size_t obstacle = 1; obstacle < track_of.size(); ++obstacle) {
        is_moving[obstacle] =
            std::find(moving.begin(), moving.end(), track_of[obstacle]) != moving.end();
    }
    still_->update(withoutObstacles(scan, is_moving));
}

}  // namespace hagen::avoidance
