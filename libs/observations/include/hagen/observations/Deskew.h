#pragma once
#include <hagen/observations/Trajectory.h>
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <mrpt/core/Clock.h>
#include <mrpt/poses/CPose3D.h>

namespace hagen::observations {

/// Stage 10 begins with it: moves each return of a scan that was taken on the way to where the
/// sensor would have seen it at `start`, the scan's time, by the vehicle's pose at the return's own
/// time (start + time_s). Range, azimuth and row are worked out anew. A sensor that did not move
/// leaves the returns as they are, to rounding.
///
/// Requires scan.time_s. False, and the scan untouched, where the trajectory does not reach from
/// the first return to the last.
bool deskew(const Trajectory& vehicle, mrpt::Clock::time_point start,
            const mrpt::poses::CPose3D& sensor_on_vehicle, const SensorModel& sensor, Scan& scan);

}  // namespace hagen::observations
