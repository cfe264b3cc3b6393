#include "live/autopilot/GroundBelow.h"

#include <cmath>

namespace hagen::live {
namespace {

constexpr float kMinSlope = 0.5f;  // cosine of the maximum tilt
constexpr int kSteps = 8;          // iterations to intersect the axis with the surface
constexpr int kMinPixels = 20;
constexpr float kClose_m = 0.3f, kNear_m = 20;

/// Whether enough pixels nearby look like ground and lie on the surface.
bool isShown(const Ground& ground) {
    int shown = 0;
    for (Eigen::Index i = 0; i < ground.height_m.size(); ++i) {
        const float x_m = ground.pixels.x_m(i), y_m = ground.pixels.y_m(i);
        const bool is_near = x_m * x_m + y_m * y_m < kNear_m * kNear_m;
        const bool is_close = std::abs(ground.height_m(i)) < kClose_m;
        shown += is_near && is_close && std::isfinite(ground.tolerance_m(i)) ? 1 : 0;
    }
    return shown >= kMinPixels;
}

}  // namespace

std::optional<float> groundBelow(const Ground& ground, const Eigen::Matrix3f& vehicle_from_sensor) {
    if (!ground.is_seen || !ground.has_surface || !isShown(ground)) return std::nullopt;
    const Eigen::Vector3f down =
        ground.from_sensor.linear() * vehicle_from_sensor.transpose() * Eigen::Vector3f(0, 0, -1);
    if (-down.z() < kMinSlope) return std::nullopt;
    const Eigen::Vector3f from_m = ground.from_sensor.translation();
    float distance_m = 0;
    for (int step = 0; step < kSteps; ++step) {
        const Eigen::Vector3f at_m = from_m + distance_m * down;
        distance_m += (at_m.z() - ground.surface.at(at_m.x(), at_m.y())) / -down.z();
    }
    if (!(distance_m > 0) || !std::isfinite(distance_m)) return std::nullopt;
    return distance_m;
}

}  // namespace hagen::live
