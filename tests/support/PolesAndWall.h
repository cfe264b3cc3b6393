#pragma once
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

namespace hagen::test {

/// The recording rawlogs/poles_and_wall.rawlog, scan by scan: a vehicle flies at 3 m/s along x, 1.2
/// m above flat ground, between two rows of poles towards a wall; its VLP-16 turns at 10 Hz. The
/// vehicle's pose precedes each scan and also follows the last.
constexpr int kPolesAndWallScans = 10;
mrpt::obs::CObservationRobotPose::Ptr polesAndWallPose(int scan);
mrpt::obs::CObservationVelodyneScan::Ptr polesAndWallScan(int scan);

}  // namespace hagen::test
