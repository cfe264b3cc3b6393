#include "support/SimpleScene.h"

#include <hagen/scan/RangeImage.h>
#include <cmath>

namespace hagen::test {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

/// Distance at which the ray enters the box: the last entry into one of the three pairs of planes,
/// if it precedes the first exit.
double rangeTo(const SimpleScene::Box& box, const Eigen::Vector3d& origin,
               const Eigen::Vector3d& direction) {
    double enter = 0.0, leave = kNothing;
    for (int axis = 0; axis < 3; ++axis) {
        double near = (box.low_m[axis] - origin[axis]) / direction[axis];
        double far = (box.high_m[axis] - origin[axis]) / direction[axis];
        if (near > far) std::swap(near, far);
        enter = std::max(enter, near);
        leave = std::min(leave, far);
    }
    return enter > 0.0 && enter <= leave ? enter : kNothing;
}

/// Distance at which the ray hits the pole, in the horizontal plane: |origin + t direction -
/// axis|^2 = radius^2.
double rangeTo(const SimpleScene::Pole& pole, const Eigen::Vector3d& origin,
               const Eigen::Vector3d& direction) {
    const Eigen::Vector2d from_axis(origin.x() - pole.x_m, origin.y() - pole.y_m);
    const Eigen::Vector2d along = direction.head<2>();
    const double a = along.squaredNorm(), b = from_axis.dot(along);
    const double c = from_axis.squaredNorm() - pole.radius_m * pole.radius_m;
    if (b * b < a * c) return kNothing;
    const double range = (-b - std::sqrt(b * b - a * c)) / a;
    const double height = origin.z() + range * direction.z();
    return range > 0.0 && height >= 0.0 && height <= pole.height_m ? range : kNothing;
}

double rangeTo(const SimpleScene::Floor& floor, const Eigen::Vector3d& origin,
               const Eigen::Vector3d& direction) {
    if (!(direction.z() < 0.0)) return kNothing;
    const double range = (floor.z_m - origin.z()) / direction.z();
    const Eigen::Array2d at = (origin + range * direction).head<2>();
    const bool is_inside = (at >= floor.low_m.array()).all() && (at <= floor.high_m.array()).all();
    return range > 0.0 && is_inside ? range : kNothing;
}

}  // namespace

Hit castRay(const SimpleScene& scene, const Eigen::Vector3d& origin_m,
            const Eigen::Vector3d& direction) {
    Hit hit;
    const auto meet = [&](double range_m, Label label) {
        if (range_m < hit.range_m) hit = {range_m, label};
    };
    if (scene.has_ground && direction.z() < 0.0) meet(-origin_m.z() / direction.z(), Label::Rou);
    for (const auto& floor : scene.floors) meet(rangeTo(floor, origin_m, direction), Label::Rou);
    for (const auto& box : scene.boxes) meet(rangeTo(box, origin_m, direction), Label::Roi);
    for (const auto& pole : scene.poles) meet(rangeTo(pole, origin_m, direction), Label::Roi);
    return hit;
}

Eigen::Vector3d directionOf(double azimuth_rad, double elevation_rad) {
    return {std::cos(elevation_rad) * std::cos(azimuth_rad),
            std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

LabelledScan scanScene(const SimpleScene& scene, const SensorModel& sensor, int columns,
                       const Eigen::Vector3d& position_m, const Eigen::Matrix3d& world_from_sensor,
                       const ChangeHit& change) {
    LabelledScan result;
    for (int column = 0; column < columns; ++column) {
        for (int row = 0; row < sensor.rows(); ++row) {
            const Eigen::Vector3d direction = directionOf(
                columnAzimuth(column, columns), static_cast<double>(sensor.elevations_rad[row]));
            const Eigen::Vector3d in_world = world_from_sensor * direction;
            Hit hit = castRay(scene, position_m, in_world);
            change(in_world, hit);
            if (hit.range_m > static_cast<double>(sensor.max_range_m)) continue;
            const Eigen::Vector3f point = (hit.range_m * direction).cast<float>();
            result.scan.x_m.push_back(point.x());
            result.scan.y_m.push_back(point.y());
            result.scan.z_m.push_back(point.z());
            result.scan.intensity.push_back(0.5f);
            result.truth.push_back(hit.label);
        }
    }
    locateBeams(sensor, result.scan);
    return result;
}

}  // namespace hagen::test
