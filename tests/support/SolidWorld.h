#pragma once
#include <hagen/avoidance/WorldModel.h>

namespace hagen::test {

/// A perfect model of a world of simple solids, with exact distances.
class SolidWorld : public avoidance::WorldModel {
 public:
    SolidWorld& sphere(const Eigen::Vector3f& middle_m, float radius_m) {
        spheres_.push_back({middle_m, radius_m});
        return *this;
    }
    /// Adds an upright, infinitely high trunk.
    SolidWorld& trunk(const Eigen::Vector2f& middle_m, float radius_m) {
        trunks_.push_back({{middle_m.x(), middle_m.y(), 0}, radius_m});
        return *this;
    }
    SolidWorld& box(const Eigen::Vector3f& min_m, const Eigen::Vector3f& max_m) {
        boxes_.push_back({min_m, max_m});
        return *this;
    }
    SolidWorld& ground(float height_m) {
        ground_m_ = height_m;
        return *this;
    }
    /// Makes space outside this box unknown.
    SolidWorld& knownWithin(const Eigen::AlignedBox3f& box_m) {
        known_m_ = box_m;
        return *this;
    }

    void update(const observations::MappedScan&) override {}

    float clearance_m(const Eigen::Vector3f& point_m) const override {
        ++asked;
        return std::min(kReach_m, distance_m(point_m));
    }
    bool isKnown(const Eigen::Vector3f& point_m) const override {
        return known_m_.isEmpty() || known_m_.contains(point_m);
    }
    std::size_t bytes() const override { return 0; }
    Obstacles obstacles() const override { return {}; }

    /// Distance to the nearest surface at any range; 0 inside a solid.
    float distance_m(const Eigen::Vector3f& point_m) const {
        float min_m = point_m.z() - ground_m_;
        for (const Ball& ball : spheres_) {
            min_m = std::min(min_m, (point_m - ball.middle_m).norm() - ball.radius_m);
        }
        for (const Ball& trunk : trunks_) {
            min_m = std::min(min_m, (point_m - trunk.middle_m).head<2>().norm() - trunk.radius_m);
        }
        for (const Eigen::AlignedBox3f& box_m : boxes_) {
            min_m = std::min(min_m, box_m.exteriorDistance(point_m));
        }
        return std::max(0.0f, min_m);
    }

    mutable long asked = 0;

 private:
    struct Ball {
        Eigen::Vector3f middle_m;
        float radius_m;
    };
    std::vector<Ball> spheres_, trunks_;
    std::vector<Eigen::AlignedBox3f> boxes_;
    Eigen::AlignedBox3f known_m_;
    float ground_m_ = -1000;
};

}  // namespace hagen::test
