#pragma once
#include <hagen/mrpt/Trajectory.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <mrpt/core/Clock.h>
#include <mrpt/poses/CPose3D.h>

namespace hagen::observations {

/// Deskews a scan: moves each return to where the sensor would have measured it at `start`, the
/// scan's time, using the vehicle's pose at the return's own time (start + time_s). Recomputes
/// range, azimuth and row.
///
/// Requires scan.time_s. Returns false, with the scan unchanged, if the trajectory does not cover
/// all returns.
bool deskew(const Trajectory& vehicle, mrpt::Clock::time_point start,
            const mrpt::poses::CPose3D& sensor_on_vehicle, const SensorModel& sensor, Scan& scan);

}  // namespace hagen::observations
