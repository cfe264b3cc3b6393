#pragma once
#include <hagen/simulation/Lidar.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/poses/CPose3D.h>

namespace hagen::convert {

mrpt::poses::CPose3D mrptPose(const simulation::SensorPose& pose);

/// Encodes a simulated scan as raw packets. Decoding them yields the scan's returns in the same
/// order, with ranges rounded to 2 mm; times are relative to `hour_s`, the scan's time since a full
/// hour. Throws std::invalid_argument for sensors other than VLP-16 and HDL-32E.
mrpt::obs::CObservationVelodyneScan::Ptr encodeSimulatedScan(const simulation::SimulatedScan& scan,
                                                             const SensorModel& sensor,
                                                             double hour_s);

}  // namespace hagen::convert
