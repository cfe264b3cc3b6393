#pragma once
#include <hagen/filter/Levelling.h>
#include <hagen/mrpt/ScanPose.h>
#include <mrpt/poses/CPose3D.h>

namespace hagen::observations {

/// Applies a sensor's mount to its pose: the `recorded` mount, already part of `pose`, or the
/// settings' `mount` if the recorded one is level. Poses of the sensor itself include the mount.
/// With unknown attitude, assumes a level vehicle; a level sensor then has no attitude.
ScanPose mountedPose(const ScanPose& pose, const mrpt::poses::CPose3D& recorded,
                     const Attitude& mount);

/// The recorded mount of a sensor or, if that is level (up to rounding), the settings' mount.
Attitude mountOf(const Attitude& recorded, const Attitude& mount);

}  // namespace hagen::observations
