#pragma once
#include <hagen/filter/Levelling.h>
#include <hagen/mrpt/ScanPose.h>
#include <mrpt/poses/CPose3D.h>

namespace hagen::observations {

/// Applies the mount of a sensor to its pose: the `recorded` one, which `pose` already contains, or
/// the `mount` of the settings if that is level. Poses of the sensor itself contain the mount.
/// Without a known attitude, the vehicle is assumed level; a level sensor then has no attitude.
ScanPose mountedPose(const ScanPose& pose, const mrpt::poses::CPose3D& recorded,
                     const Attitude& mount);

/// The mount of a sensor: as recorded or, if that is level (up to rounding), that of the settings.
Attitude mountOf(const Attitude& recorded, const Attitude& mount);

}  // namespace hagen::observations
