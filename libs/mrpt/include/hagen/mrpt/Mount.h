#pragma once
#include <hagen/filter/Levelling.h>
#include <hagen/mrpt/ScanPose.h>
#include <mrpt/poses/CPose3D.h>

namespace hagen::observations {

/// The pose of a sensor that is mounted as its scan says (`recorded`, which `pose` contains) or, if
/// that is level, tilted there as the settings say (`mount`). Poses of the sensor itself contain
/// the tilt. If no attitude is known, the vehicle is taken to be level; if the sensor is level on
/// it, too, there is none.
ScanPose mountedPose(const ScanPose& pose, const mrpt::poses::CPose3D& recorded,
                     const Attitude& mount);

/// How a sensor is tilted on its vehicle: as recorded or, if that is level but for rounding, as the
/// settings say.
Attitude mountOf(const Attitude& recorded, const Attitude& mount);

}  // namespace hagen::observations
