#pragma once
#include <hagen/evaluation/ScanScores.h>
#include <Eigen/Core>
#include <vector>

namespace hagen::evaluation {

/// Coordinates of the returns in a frame at the sensor whose z points up: turned by
/// levelFromSensor() of the scan. Returns without a range, or beyond 10 km, are
/// NaN.
std::vector<Eigen::Vector3f> levelPoints(const GroundTruthScan& scan);

/// Heights of obstacle returns above the true ground, which the labels of no method can change.
///
/// Ground is known in cells of kGroundCell_m: the median height of the returns in the cell whose
/// truth is ROU, at any range. The height of an obstacle return is that above the median of the
/// ground cells within kGroundNear_m of its own cell (between centres, horizontally); if there are
/// none, above that of the kGroundCells nearest ones (with those equally near as the last).
///
/// `points_m` are levelPoints() of the scan. Returns one value per return [m]: NaN unless its truth
/// is RoI and its range at most `max_range_m`; infinite if the scan has no ground, because an
/// obstacle of unknown height must not count as low.
std::vector<float> heightsAboveTrueGround(const GroundTruthScan& scan,
                                          const std::vector<Eigen::Vector3f>& points_m,
                                          float max_range_m);

constexpr float kGroundCell_m = 0.5f, kGroundNear_m = 3.0f;
constexpr std::size_t kGroundCells = 20;

}  // namespace hagen::evaluation
