#pragma once
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <Eigen/Core>
#include <functional>
#include <limits>
#include <utility>

namespace hagen::test {

/// A world of flat ground (z = 0), floors at other heights, upright boxes and cylindrical poles.
/// Ranges and labels have closed forms: ground and floors are ROU, the rest is RoI.
struct SimpleScene {
    struct Box {
        Eigen::Vector3d low_m, high_m;
    };
    struct Pole {
        double x_m, y_m, radius_m, height_m;
    };
    /// A level rectangle, visible only from above.
    struct Floor {
        Eigen::Vector2d low_m, high_m;
        double z_m;
    };
    std::vector<Box> boxes;
    std::vector<Pole> poles;
    std::vector<Floor> floors;
    bool has_ground = true;
};

/// Obstacles on flat ground.
inline SimpleScene sceneOf(std::vector<SimpleScene::Box> boxes,
                           std::vector<SimpleScene::Pole> poles = {}) {
    return {std::move(boxes), std::move(poles), {}, true};
}

/// A yard with two walls, a step and three poles.
inline SimpleScene yard() {
    return sceneOf({{{4, -9, 0}, {12, -7, 3}}, {{-14, 4, 0}, {-6, 5, 2}}, {{5, 2, 0}, {6, 3, 0.4}}},
                   {{7, 1, 0.1, 4}, {-5, -3, 0.15, 5}, {3, -4, 0.05, 1}});
}

/// The first hit of a ray.
struct Hit {
    double range_m = std::numeric_limits<double>::infinity();  ///< infinite if nothing is hit
    Label label = Label::Unclassified;
};
Hit castRay(const SimpleScene& scene, const Eigen::Vector3d& origin_m,
            const Eigen::Vector3d& direction);

/// A scan with the ground truth of each return.
struct LabelledScan {
    Scan scan;
    std::vector<Label> truth;
};

/// Changes the hit of a ray; the direction is in world coordinates.
using ChangeHit = std::function<void(const Eigen::Vector3d& direction, Hit& hit)>;

/// A scan from `position_m`, level by default, with one ray through the centre of each pixel of an
/// image with `columns` columns.
LabelledScan scanScene(
    const SimpleScene& scene, const SensorModel& sensor, int columns,
    const Eigen::Vector3d& position_m,
    const Eigen::Matrix3d& world_from_sensor = Eigen::Matrix3d::Identity(),
    const ChangeHit& change = [](const Eigen::Vector3d&, Hit&) {});

/// The direction of a beam in the sensor frame.
Eigen::Vector3d directionOf(double azimuth_rad, double elevation_rad);

}  // namespace hagen::test
