#pragma once
#include <hagen/segmentation/Levelling.h>
#include <Eigen/Geometry>
#include <optional>

namespace hagen::streaming {

/// Tilt and pose of a sensor, as far as they are known: what StreamingSegmenter takes.
struct SensorMotion {
    std::optional<Attitude> attitude;
    std::optional<Eigen::Isometry3d> map_from_sensor;
};

}  // namespace hagen::streaming
