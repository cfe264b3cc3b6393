#include "filter/simd/GroundFrame.h"

namespace hagen {
namespace {

// Conditions for the plane to be ground.
constexpr float kMinHeight_m = -0.3f;  // height of the sensor above the plane
constexpr float kMinCosine = 0.7071f;  // cosine of the sensor's tilt (45 degrees)
constexpr Eigen::Index kMinPixels = 20;

}  // namespace

bool canBeGround(const Eigen::Isometry3f& ground_from_sensor,
                 const std::optional<Attitude>& attitude, const Image<Label>& labels) {
    const float sensor_height_m = ground_from_sensor.translation().z();
    const float cosine_of_tilt = upwards(ground_from_sensor, attitude.value_or(Attitude{})).z();
    return sensor_height_m > kMinHeight_m && cosine_of_tilt > kMinCosine &&
           (labels == Label::Rou).count() >= kMinPixels;
}

Eigen::Vector3f upwards(const Eigen::Isometry3f& ground_from_sensor,
                        const std::optional<Attitude>& attitude) {
    if (!attitude) return Eigen::Vector3f::UnitZ();
    return ground_from_sensor.linear() * levelFromSensor(*attitude).transpose() *
           Eigen::Vector3f::UnitZ();
}

}  // namespace hagen
