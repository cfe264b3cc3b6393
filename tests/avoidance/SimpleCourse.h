#pragma once
#include <hagen/avoidance/Course.h>
#include <hagen/avoidance/WorldModel.h>

#include "simulation/SimpleContent.h"

namespace hagen::test {

/// A course of 20 m along x, 2 m above level ground.
inline avoidance::Course simpleCourse(simulation::SceneContent content, std::uint64_t seed = 1) {
    put(content, simulation::ObjectClass::Terrain, 0, plane());
    const simulation::Scene scene(std::move(content));
    const Eigen::AlignedBox3d bounds(Eigen::Vector3d(-6, -12, -1), Eigen::Vector3d(26, 12, 6));
    return {"simple",  seed,
            scene,     simulation::SceneDistance(scene, bounds, avoidance::WorldModel::kReach_m),
            {0, 0, 2}, {20, 0, 2},
            2,         bounds,
            20};
}

/// Adds a wall across the course, from x = 10 to 10.2 m and between two values of y, 8 m high.
inline void putWall(simulation::SceneContent& content, float from_y_m, float to_y_m) {
    simulation::Shape wall;
    wall.addBox({10.0f, from_y_m, 0}, {10.2f, to_y_m, 8});
    put(content, simulation::ObjectClass::Wall, 1, std::move(wall));
}

}  // namespace hagen::test
