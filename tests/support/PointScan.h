#pragma once
#include <hagen/scan/Angle.h>

#include "support/SimpleScene.h"

namespace hagen::test {

/// A scan of these points in the sensor frame, in this order.
inline Scan scanOf(const SensorModel& sensor, const std::vector<Eigen::Vector3f>& points_m) {
    Scan scan;
    for (const Eigen::Vector3f& p : points_m) {
        scan.x_m.push_back(p.x());
        scan.y_m.push_back(p.y());
        scan.z_m.push_back(p.z());
        scan.intensity.push_back(0.5f);
    }
    locateBeams(sensor, scan);
    return scan;
}

/// The point on a beam at this azimuth and range.
inline Eigen::Vector3f onBeam(const SensorModel& sensor, int row, double azimuth_deg,
                              double range_m) {
    const double elevation_rad = static_cast<double>(sensor.elevations_rad[row]);
    return (range_m * directionOf(radians(azimuth_deg), elevation_rad)).cast<float>();
}

}  // namespace hagen::test
