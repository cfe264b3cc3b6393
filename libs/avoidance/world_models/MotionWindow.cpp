#include "avoidance/world_models/MotionWindow.h"

namespace hagen::avoidance {

void MotionWindow::update(const observations::MappedScan& scan) {
    const auto view = std::make_shared<const View>(viewOf(scan));
    movers_.update(scan, view);
    window_.update(scan, view, movers_.tracks().trackOfObstacle());
    window_.hide(movers_.moving());
}

float MotionWindow::clearance_m(const Eigen::Vector3f& point_m) const {
    return clearanceWithin_m(point_m, kReach_m);
}

float MotionWindow::clearanceWithin_m(const Eigen::Vector3f& point_m, float limit_m) const {
    return movers_.clearanceWithin_m(point_m, 0, window_.clearanceWithin_m(point_m, limit_m));
}

WorldModel::ClearanceQuery MotionWindow::clearanceQuery(const Eigen::AlignedBox3f& box_m,
                                                        float limit_m) const {
    return
        [this, still_m = window_.clearanceQuery(box_m, limit_m)](const Eigen::Vector3f& point_m) {
            return movers_.clearanceWithin_m(point_m, 0, still_m(point_m));
        };
}

float MotionWindow::clearanceAfter_m(const Eigen::Vector3f& point_m, double after_s) const {
    return movers_.clearanceWithin_m(point_m, static_cast<float>(after_s),
                                     window_.clearance_m(point_m));
}

WorldModel::Obstacles MotionWindow::obstacles() const {
    Obstacles obstacles = window_.obstacles();
    movers_.addTo(obstacles);
    return obstacles;
}

}  // namespace hagen::avoidance
