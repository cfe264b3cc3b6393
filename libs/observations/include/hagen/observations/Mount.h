#pragma once
#include <hagen/observations/ScanPose.h>
#include <hagen/segmentation/Levelling.h>
#include <mrpt/poses/CPose3D.h>

#include <optional>

namespace hagen::observations {

/// The tilt of a sensor, mounted as the recording says (`sensor_on_vehicle`) or, if that is level,
/// as the settings say (`mount`). If the vehicle's attitude is unknown, the vehicle is taken to be
/// level; if the mount is level too, nothing is known.
std::optional<Attitude> sensorTilt(const ScanPose& pose,
                                   const mrpt::poses::CPose3D& sensor_on_vehicle,
                                   const Attitude& mount);

}  // namespace hagen::observations
