#include "filter/image/Posture.h"
#include <hagen/scan/Angle.h>
#include <algorithm>
#include <cmath>
#include <vector>

namespace hagen {
namespace {

constexpr float kMaxTiltCosine = 0.8660254f;         // cosine of 30 degrees
constexpr float kMaxVirtualTiltCosine = 0.9659258f;  // cosine of 15 degrees
constexpr double kMinSpacing_deg = 1;

double medianSpacing_deg(const SensorModel& sensor) {
    std::vector<double> spacing_deg;
    for (int row = 1; row < sensor.rows(); ++row) {
        spacing_deg.push_back(degrees(static_cast<double>(sensor.elevations_rad[row]) -
                                      static_cast<double>(sensor.elevations_rad[row - 1])));
    }
    const auto middle = spacing_deg.begin() + static_cast<std::ptrdiff_t>(spacing_deg.size() / 2);
    std::nth_element(spacing_deg.begin(), middle, spacing_deg.end());
    return std::max(kMinSpacing_deg, *middle);
}

SensorModel mirrored(SensorModel sensor) {
    std::reverse(sensor.elevations_rad.begin(), sensor.elevations_rad.end());
    for (float& elevation_rad : sensor.elevations_rad) elevation_rad = -elevation_rad;
    return sensor;
}

SensorModel allAround(SensorModel sensor) {
    const int gaps = static_cast<int>(std::lround(180 / medianSpacing_deg(sensor)));
    sensor.elevations_rad.clear();
    for (int row = 0; row <= gaps; ++row) {
        sensor.elevations_rad.push_back(static_cast<float>(kPi * row / gaps - 0.5 * kPi));
    }
    return sensor;
}

/// Rotates by 180 degrees about x, exactly; returns keep their rows.
void turnUpsideDown(const Scan& scan, const SensorModel& rows_of, Scan& turned) {
    const std::size_t size = scan.size();
    turned.x_m = scan.x_m;
    turned.range_m = scan.range_m;
    turned.y_m.resize(size);
    turned.z_m.resize(size);
    turned.azimuth_rad.resize(size);
    turned.row.resize(size);
    const int last = rows_of.rows() - 1;
    for (std::size_t i = 0; i < size; ++i) {
        turned.y_m[i] = -scan.y_m[i];
        turned.z_m[i] = -scan.z_m[i];
        turned.azimuth_rad[i] = -scan.azimuth_rad[i];
        turned.row[i] = static_cast<std::uint8_t>(last - scan.row[i]);
    }
    turned.beams = beamSpan(rows_of);
}

void level(const Scan& scan, const Eigen::Matrix3f& level_from_sensor, const SensorModel& rows_of,
           Scan& turned) {
    rotatePoints(level_from_sensor, scan, turned);
    locateBeams(rows_of, turned);
    // Rotation preserves ranges; returns without range (such as the airframe) stay without range.
    turned.range_m = scan.range_m;
}

}  // namespace

Posture postureOf(const std::optional<Attitude>& attitude, const SensorModel& sensor) {
    if (!attitude) return Posture::Upright;
    const std::vector<float>& rows_rad = sensor.elevations_rad;
    const bool is_coarse =
        degrees(static_cast<double>(rows_rad[1] - rows_rad[0])) > kMinSpacing_deg;
    const float max_cosine =
        sensor.has_rings || !is_coarse ? kMaxTiltCosine : kMaxVirtualTiltCosine;
    const float up = levelFromSensor(*attitude)(2, 2);  // cosine of the tilt
    if (up < -max_cosine) return Posture::UpsideDown;
    return up < max_cosine ? Posture::OnItsSide : Posture::Upright;
}

SensorModel sensorIn(Posture posture, const SensorModel& sensor) {
    switch (posture) {
        case Posture::UpsideDown:
            return mirrored(sensor);
        case Posture::OnItsSide:
            return allAround(sensor);
        case Posture::Upright:
            break;
    }
    return sensor;
}

Eigen::Matrix3f imageFromSensor(Posture posture, const std::optional<Attitude>& attitude) {
    switch (posture) {
        case Posture::UpsideDown:
            return Eigen::Matrix3f(Eigen::Vector3f(1, -1, -1).asDiagonal());
        case Posture::OnItsSide:
            return levelFromSensor(*attitude);
        case Posture::Upright:
            break;
    }
    return Eigen::Matrix3f::Identity();
}

std::optional<Attitude> attitudeIn(Posture posture, const std::optional<Attitude>& attitude) {
    switch (posture) {
        case Posture::UpsideDown:
            return Attitude{
                attitude->roll_rad - std::copysign(static_cast<float>(kPi), attitude->roll_rad),
                attitude->pitch_rad};
        case Posture::OnItsSide:
            return Attitude{};
        case Posture::Upright:
            break;
    }
    return attitude;
}

void rotatePoints(const Eigen::Matrix3f& turn, const Scan& scan, Scan& turned) {
    const std::size_t size = scan.size();
    for (auto* coordinate : {&turned.x_m, &turned.y_m, &turned.z_m}) coordinate->resize(size);
    for (std::size_t i = 0; i < size; ++i) {
        const Eigen::Vector3f point_m =
            turn * Eigen::Vector3f(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
        turned.x_m[i] = point_m.x();
        turned.y_m[i] = point_m.y();
        turned.z_m[i] = point_m.z();
    }
}

void turnScan(const Scan& scan, Posture posture, const std::optional<Attitude>& attitude,
              const SensorModel& rows_of, Scan& turned) {
    if (posture == Posture::UpsideDown) {
        turnUpsideDown(scan, rows_of, turned);
    } else {
        level(scan, levelFromSensor(*attitude), rows_of, turned);
    }
}

}  // namespace hagen
