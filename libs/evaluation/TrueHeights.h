#pragma once
#include <hagen/evaluation/ScanScores.h>
#include <Eigen/Core>
#include <vector>

namespace hagen::evaluation {

/// Coordinates of the returns, rotated by levelFromSensor() of the scan. NaN if the range is
/// missing or above 10 km.
std::vector<Eigen::Vector3f> levelPoints(const GroundTruthScan& scan);

/// Heights of obstacle returns above the true ground, independent of any method.
///
/// The ground of a cell of kGroundCell_m is the median height of its ROU returns, at any range.
/// Heights are relative to the median of the ground cells within kGroundNear_m of the return's cell
/// (horizontally, between centres). If there are none, the kGroundCells nearest cells are used, and
/// all others that are as near as the last of them.
///
/// `points_m`: levelPoints() of the scan. Returns one value per return [m]: NaN unless its truth is
/// RoI and its range at most `max_range_m`; infinite without ground, so that an obstacle of unknown
/// height is not regarded as low.
std::vector<float> heightsAboveTrueGround(const GroundTruthScan& scan,
                                          const std::vector<Eigen::Vector3f>& points_m,
                                          float max_range_m);

constexpr float kGroundCell_m = 0.5f, kGroundNear_m = 3.0f;
constexpr std::size_t kGroundCells = 20;

}  // namespace hagen::evaluation
