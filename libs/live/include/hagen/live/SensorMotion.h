#pragma once
#include <hagen/filter/Levelling.h>
#include <Eigen/Geometry>
#include <optional>

namespace hagen::live {

/// Tilt and pose of a sensor, if known, for StreamingSegmenter.
struct SensorMotion {
    std::optional<Attitude> attitude;
    std::optional<Eigen::Isometry3d> map_from_sensor;
};

}  // namespace hagen::live
