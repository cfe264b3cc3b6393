#include "simulation/SceneBuilder.h"
#include <hagen/scan/Angle.h>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace hagen::simulation {

SceneBuilder::SceneBuilder(const TerrainParameters& form, const Path& path,
                           const GroundExtent& extent, const Random& random)
    : random_(random), content_{Terrain(form, random_), path, {}, {}, {}} {
    add(ObjectClass::Terrain,
        terrain().mesh(extent.half_length_m, extent.half_width_m, extent.reach_m, random_));
}

SceneBuilder::SceneBuilder(const TerrainParameters& form, const Path& path, std::uint64_t seed)
    : SceneBuilder(form, path, {}, Random(seed, 1)) {}

SceneBuilder::SceneBuilder(const TerrainParameters& form, const GroundExtent& extent,
                           const Random& random)
    : SceneBuilder(form, {}, extent, random) {}

std::size_t SceneBuilder::addShape(Shape shape) {
    content_.shapes.push_back(std::move(shape));
    return content_.shapes.size() - 1;
}

std::vector<std::size_t> SceneBuilder::addShapes(int count,
                                                 const std::function<Shape(Random&)>& make) {
    std::vector<std::size_t> shapes;
    for (int i = 0; i < count; ++i) shapes.push_back(addShape(make(random_)));
    return shapes;
}

std::size_t SceneBuilder::randomOf(const std::vector<std::size_t>& shapes) {
    return shapes[random_.uniformInt(static_cast<int>(shapes.size()))];
}

bool SceneBuilder::isFree(double x_m, double y_m, double radius_m) const {
    return path().distance_m(x_m, y_m) > radius_m + kClearance_m;
}

std::uint16_t SceneBuilder::nextNumber(ObjectClass kind) {
    if (labelOf(kind) != Label::Roi) return 0;
    if (numbers_ == std::numeric_limits<std::uint16_t>::max()) {
        throw std::logic_error("a scene contains at most 65535 objects");
    }
    return ++numbers_;
}

std::uint16_t SceneBuilder::place(ObjectClass kind, std::size_t shape, double x_m, double y_m,
                                  double yaw_rad, const Eigen::Vector3d& scale) {
    const Eigen::Affine3d pose = Eigen::Translation3d(x_m, y_m, terrain().height_m(x_m, y_m)) *
                                 Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                                 Eigen::Scaling(scale);
    content_.objects.push_back({kind, nextNumber(kind), shape, pose.cast<float>()});
    return content_.objects.back().number;
}

std::uint16_t SceneBuilder::placeRandomOf(ObjectClass kind, const std::vector<std::size_t>& shapes,
                                          double x_m, double y_m, const Eigen::Vector3d& scale) {
    const std::size_t shape = randomOf(shapes);
    return place(kind, shape, x_m, y_m, random_.uniform(0, 2 * kPi), scale);
}

std::uint16_t SceneBuilder::placeOnSlope(ObjectClass kind, std::size_t shape, double x_m,
                                         double y_m, double yaw_rad, const Eigen::Vector3d& scale) {
    const std::uint16_t number = place(kind, shape, x_m, y_m, yaw_rad, scale);
    constexpr double kStep_m = 2.0;
    Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
    shear(2, 0) =
        (terrain().height_m(x_m + kStep_m, y_m) - terrain().height_m(x_m - kStep_m, y_m)) /
        (2 * kStep_m);
    shear(2, 1) =
        (terrain().height_m(x_m, y_m + kStep_m) - terrain().height_m(x_m, y_m - kStep_m)) /
        (2 * kStep_m);
    Eigen::Affine3f& pose = content_.objects.back().pose;
    pose.linear() = shear.cast<float>() * pose.linear();
    return number;
}

std::uint16_t SceneBuilder::add(ObjectClass kind, Shape shape) {
    content_.objects.push_back(
        {kind, nextNumber(kind), addShape(std::move(shape)), Eigen::Affine3f::Identity()});
    return content_.objects.back().number;
}

bool SceneBuilder::addMover(MovingObstacle mover, double own_radius_m) {
    constexpr int kPlaces = 24;
    for (int i = 0; i < kPlaces; ++i) {
        const double angle = 2 * kPi * i / kPlaces;
        if (!isFree(mover.middle_m.x() + mover.radius_m * std::cos(angle),
                    mover.middle_m.y() + mover.radius_m * std::sin(angle), own_radius_m + 0.7)) {
            return false;
        }
    }
    addRandomMover(mover);
    return true;
}

void SceneBuilder::addRandomMover(MovingObstacle mover) {
    mover.number = nextNumber(ObjectClass::Mover);
    content_.movers.push_back(mover);
}

void SceneBuilder::scatter(double per_m2, const std::function<void(double, double)>& put) {
    const int count = random_.poisson(per_m2 * 4 * kHalfLength_m * kHalfWidth_m);
    for (int i = 0; i < count; ++i) {
        const double x_m = random_.uniform(-kHalfLength_m, kHalfLength_m);
        const double y_m = random_.uniform(-kHalfWidth_m, kHalfWidth_m);
        put(x_m, y_m);
    }
}

}  // namespace hagen::simulation
