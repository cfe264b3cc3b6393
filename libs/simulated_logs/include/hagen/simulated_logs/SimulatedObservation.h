#pragma once
#include <hagen/simulation/Lidar.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/poses/CPose3D.h>

namespace hagen::simulated_logs {

/// A pose as MRPT has it.
mrpt::poses::CPose3D mrptPose(const simulation::SensorPose& pose);

/// A simulated scan as genuine packets. Decoded, they give the scan's returns in its order, ranges
/// rounded to 2 mm; times count from `hour_s`, the scan's time since a full hour. Throws
/// std::invalid_argument for sensors other than VLP-16 and HDL-32E.
mrpt::obs::CObservationVelodyneScan::Ptr encodeSimulated(const simulation::SimulatedScan& scan,
                                                         const SensorModel& sensor, double hour_s);

}  // namespace hagen::simulated_logs
