#include "scan/MoveReturns.h"

#include <hagen/scan/Image.h>
#include <cmath>

namespace hagen {

void moveReturns(const Eigen::Isometry3d& motion, std::size_t first, Scan& scan) {
    const Eigen::Matrix3f turn = motion.linear().cast<float>();
    const Eigen::Vector3f way_m = motion.translation().cast<float>();
    float* const x_m = scan.x_m.data();
    float* const y_m = scan.y_m.data();
    float* const z_m = scan.z_m.data();
    float* const range_m = scan.range_m.data();
    for (std::size_t i = first; i < scan.size(); ++i) {
        const float x = x_m[i], y = y_m[i], z = z_m[i];
        x_m[i] = turn(0, 0) * x + turn(0, 1) * y + turn(0, 2) * z + way_m.x();
        y_m[i] = turn(1, 0) * x + turn(1, 1) * y + turn(1, 2) * z + way_m.y();
        z_m[i] = turn(2, 0) * x + turn(2, 1) * y + turn(2, 2) * z + way_m.z();
        const float zero = 0 * x_m[i] + 0 * y_m[i] + 0 * z_m[i];  // NaN unless all are finite
        range_m[i] += zero;
    }
}

void locateInView(const SensorModel& sensor, Scan& scan) {
    const std::vector<float>& beams_rad = sensor.elevations_rad;
    const float lowest = std::sin(beams_rad[0] - (beams_rad[1] - beams_rad[0]));
    const std::size_t last = beams_rad.size() - 1;
    const float highest = std::sin(beams_rad[last] + (beams_rad[last] - beams_rad[last - 1]));
    locateBeams(sensor, scan);
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const float z_m = scan.z_m[i], range_m = scan.range_m[i];
        const bool is_in_view = z_m >= lowest * range_m && z_m <= highest * range_m;
        scan.range_m[i] = is_in_view ? range_m : kNoValue;
    }
}

}  // namespace hagen
