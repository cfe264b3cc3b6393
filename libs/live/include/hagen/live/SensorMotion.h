#pragma once
#include <hagen/filter/Levelling.h>
#include <Eigen/Geometry>
#include <optional>

namespace hagen::live {

/// Tilt and pose of a sensor, as far as they are known: what StreamingSegmenter takes.
struct SensorMotion {
    std::optional<Attitude> attitude;
    std::optional<Eigen::Isometry3d> map_from_sensor;
};

}  // namespace hagen::live
