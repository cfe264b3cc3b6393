#include <hagen/scan/Airframe.h>
#include <hagen/scan/Angle.h>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hagen {
namespace {

/// Tolerance for sensors whose beams do not start at the origin: their ranges differ from the norms
/// of the coordinates.
constexpr float kMaxOffset_m = 0.25f;

/// The range beyond which no return belongs to the airframe.
float reachOf(const Airframe& airframe) {
    float reach_m = 0;
    for (const AirframeBox& box : airframe.boxes) {
        reach_m = std::max(reach_m, box.low_m.cwiseAbs().cwiseMax(box.high_m.cwiseAbs()).norm());
    }
    for (const AirframeSphere& sphere : airframe.spheres) {
        reach_m = std::max(reach_m, sphere.centre_m.norm() + sphere.radius_m);
    }
    if (airframe.bin_range_m.size() > 0) {
        reach_m = std::max(reach_m, airframe.bin_range_m.maxCoeff());
    }
    return reach_m + kMaxOffset_m;
}

constexpr std::size_t kBlock = 32;  // most blocks of a scan have no near return

bool isBlockFarther(const float* range_m, float reach_m) {
    std::int32_t near_returns = 0;
    for (std::size_t i = 0; i < kBlock; ++i) near_returns += range_m[i] <= reach_m ? 1 : 0;
    return near_returns == 0;
}

bool contains(const Airframe& airframe, const Eigen::Vector3f& point_m, float range_m) {
    for (const AirframeBox& box : airframe.boxes) {
        if ((point_m.array() >= box.low_m.array()).all() &&
            (point_m.array() <= box.high_m.array()).all())
            return true;
    }
    for (const AirframeSphere& sphere : airframe.spheres) {
        if ((point_m - sphere.centre_m).squaredNorm() <= sphere.radius_m * sphere.radius_m)
            return true;
    }
    if (airframe.bin_range_m.size() == 0) return false;
    const AirframeBin bin = airframeBinOf(point_m, static_cast<int>(airframe.bin_range_m.rows()));
    return range_m <= airframe.bin_range_m(bin.row, bin.column);
}

}  // namespace

AirframeBin airframeBinOf(const Eigen::Vector3f& point_m, int rows) {
    const float elevation_rad = std::atan2(point_m.z(), std::hypot(point_m.x(), point_m.y()));
    const float azimuth_rad = std::atan2(point_m.y(), point_m.x());
    const double bins_per_rad = rows / kPi;
    const auto bin = [&](float angle_rad, double min_rad, int bins) {
        const double from_least_rad = static_cast<double>(angle_rad) - min_rad;
        return std::clamp(static_cast<int>(from_least_rad * bins_per_rad), 0, bins - 1);
    };
    return {bin(elevation_rad, -0.5 * kPi, rows), bin(azimuth_rad, -kPi, 2 * rows)};
}

std::size_t maskAirframe(const Airframe& airframe, Scan& scan) {
    if (airframe.isEmpty()) return 0;
    const float reach_m = reachOf(airframe);
    std::size_t masked = 0;
    for (std::size_t begin = 0; begin < scan.size(); begin += kBlock) {
        const std::size_t end = std::min(begin + kBlock, scan.size());
        if (end == begin + kBlock && isBlockFarther(&scan.range_m[begin], reach_m)) continue;
        for (std::size_t i = begin; i < end; ++i) {
            float& range_m = scan.range_m[i];
            if (!(range_m > 0 && range_m <= reach_m)) continue;  // also skips NaN
            if (!contains(airframe, {scan.x_m[i], scan.y_m[i], scan.z_m[i]}, range_m)) continue;
            range_m = kNoValue;
            ++masked;
        }
    }
    return masked;
}

}  // namespace hagen
