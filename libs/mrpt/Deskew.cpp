#include "mrpt/Deskew.h"
#include <Eigen/Geometry>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace hagen::observations {
namespace {

constexpr double kKnotSpacing_s = 1e-3;
constexpr double kMaxScan_s = 10;  // longer scans have corrupt timestamps

/// Returns the sensor's pose at `start` + time_s relative to `start_pose`.
std::optional<Eigen::Isometry3f> motionUntil(const Trajectory& vehicle,
                                             mrpt::Clock::time_point start,
                                             const mrpt::poses::CPose3D& start_pose,
                                             const mrpt::poses::CPose3D& sensor_on_vehicle,
                                             double time_s) {
    const auto time = start + std::chrono::duration_cast<mrpt::Clock::duration>(
                                  std::chrono::duration<double>(time_s));
    const auto pose = vehicle.at(time);
    if (!pose) return std::nullopt;
    const auto matrix = (*pose + sensor_on_vehicle - start_pose)
                            .getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
    const Eigen::Matrix4f motion = matrix.asEigen().cast<float>();
    if (!motion.allFinite()) return std::nullopt;  // 1e300 m is finite only as a double
    return Eigen::Isometry3f(motion);
}

}  // namespace

bool deskew(const Trajectory& vehicle, mrpt::Clock::time_point start,
            const mrpt::poses::CPose3D& sensor_on_vehicle, const SensorModel& sensor, Scan& scan) {
    if (scan.size() == 0) return true;
    const auto start_pose = vehicle.at(start);
    if (!start_pose) return false;
    const auto [first, last] = std::minmax_element(scan.time_s.begin(), scan.time_s.end());
    const double first_s = static_cast<double>(*first), last_s = static_cast<double>(*last);
    if (!(first_s > -kMaxScan_s && last_s < kMaxScan_s)) return false;

    // Interpolates linearly between poses sampled every millisecond. Interpolating the trajectory
    // for each return would take 100 times as long.
    const int knots = std::max(1, static_cast<int>(std::ceil((last_s - first_s) / kKnotSpacing_s)));
    const double spacing_s = (last_s - first_s) / knots;
    std::vector<Eigen::Isometry3f> motion;
    for (int knot = 0; knot <= knots; ++knot) {
        const auto until = motionUntil(vehicle, start, *start_pose + sensor_on_vehicle,
                                       sensor_on_vehicle, first_s + knot * spacing_s);
        if (!until) return false;
        motion.push_back(*until);
    }
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const double at =
            spacing_s > 0 ? (static_cast<double>(scan.time_s[i]) - first_s) / spacing_s : 0.0;
        const int knot = std::min(static_cast<int>(at), knots - 1);
        const float share = static_cast<float>(at - knot);
        const Eigen::Vector3f seen(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
        const Eigen::Vector3f before = motion[knot] * seen, after = motion[knot + 1] * seen;
        const Eigen::Vector3f moved = before + share * (after - before);
        scan.x_m[i] = moved.x();
        scan.y_m[i] = moved.y();
        scan.z_m[i] = moved.z();
    }
    locateBeams(sensor, scan);
    return true;
}

}  // namespace hagen::observations
