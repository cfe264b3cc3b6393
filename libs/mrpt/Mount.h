#pragma once
#include <hagen/filter/Levelling.h>
#include <hagen/mrpt/ScanPose.h>
#include <mrpt/poses/CPose3D.h>

namespace hagen::observations {

/// Applies a sensor's mount to its pose: the `recorded` mount, already part of `pose`, or the
/// settings' `mount` if the recorded mount is level. Poses of the sensor itself already include the
/// mount. If the attitude is unknown, the vehicle is assumed level; a level sensor then has no
/// attitude.
ScanPose mountedPose(const ScanPose& pose, const mrpt::poses::CPose3D& recorded,
                     const Attitude& mount);

/// The recorded mount of a sensor or, if it is level (up to rounding), the settings' mount.
Attitude mountOf(const Attitude& recorded, const Attitude& mount);

}  // namespace hagen::observations
