#pragma once
#include <hagen/avoidance/WindowSize.h>
#include <hagen/avoidance/WorldModel.h>
#include <memory>

/// The makers of the world models that are more than a window; each is described in its .cpp file.
namespace hagen::avoidance {

std::unique_ptr<WorldModel> makeDepthImageModel(float edge_m, const FlightPace& pace);
/// Returns beyond `max_range_m` only clear cells, up to this range.
std::unique_ptr<WorldModel> makeGridModel(float edge_m, const Eigen::AlignedBox3f& bounds_m,
                                          float max_range_m);
std::unique_ptr<WorldModel> makeRollingGridModel(float edge_m, const FlightPace& pace);
std::unique_ptr<WorldModel> makeMapWithMotion(std::unique_ptr<WorldModel> map, float farthest_m);
std::unique_ptr<WorldModel> makeWindowWithMotion(bool roi_only, WindowSize size);

}  // namespace hagen::avoidance
