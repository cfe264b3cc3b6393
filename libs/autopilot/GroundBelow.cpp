#include <hagen/autopilot/GroundBelow.h>

#include <cmath>

namespace hagen::autopilot {
namespace {

constexpr float kLeastSlope = 0.5f;  // cosine of the tilt
constexpr int kSteps = 8;            // to where the axis meets the surface

}  // namespace

std::optional<float> groundBelow(const Ground& ground, const Eigen::Matrix3f& vehicle_from_sensor) {
    if (!ground.is_seen || !ground.has_surface) return std::nullopt;
    const Eigen::Vector3f down =
        ground.from_sensor.linear() * vehicle_from_sensor.transpose() * Eigen::Vector3f(0, 0, -1);
    if (-down.z() < kLeastSlope) return std::nullopt;
    const Eigen::Vector3f from_m = ground.from_sensor.translation();
    float distance_m = 0;
    for (int step = 0; step < kSteps; ++step) {
        const Eigen::Vector3f at_m = from_m + distance_m * down;
        distance_m += (at_m.z() - ground.surface.at(at_m.x(), at_m.y())) / -down.z();
    }
    if (!(distance_m > 0) || !std::isfinite(distance_m)) return std::nullopt;
    return distance_m;
}

}  // namespace hagen::autopilot
