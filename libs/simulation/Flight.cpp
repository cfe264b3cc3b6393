#include <hagen/scan/Angle.h>
#include <hagen/simulation/Flight.h>
#include <algorithm>
#include <cmath>

namespace hagen::simulation {
namespace {

constexpr double kGravity_m_s2 = 9.81;
constexpr double kMaxLateral_m_s2 = 0.68;  // a bank of 4 degrees
constexpr double kWayStep_m = 0.25;
constexpr double kLeanPerSpeed_rad = 0.008;  // pitch due to drag, rad per m/s

}  // namespace

Flight::Flight(const Terrain& terrain, const Path& path, const FlightSettings& settings,
               std::uint64_t seed)
    : terrain_(terrain),
      path_(path),
      settings_(settings),
      lean_(std::min(1.0, settings.tilt_sd_rad / radians(4.0))) {
    Random random(seed, 2);
    roll_ = sways(settings.tilt_sd_rad, 0.1, 1.3, random);
    pitch_ = sways(settings.tilt_sd_rad, 0.1, 1.3, random);
    yaw_ = sways(radians(3.0) * lean_, 0.05, 0.5, random);
    climb_ = sways(0.04 * settings.altitude_m, 0.03, 0.2, random);
    lap_s_ = {0.0};
    for (double way_m = 0; way_m < path_.length_m(); way_m += kWayStep_m) {
        lap_s_.push_back(lap_s_.back() + kWayStep_m / speedAt(way_m));
    }
}

std::vector<Flight::Sway> Flight::sways(double sd, double slowest_hz, double fastest_hz,
                                        Random& random) {
    constexpr int kCount = 6;
    std::vector<Sway> made;
    for (int i = 0; i < kCount; ++i) {  // a sine's variance is half its squared amplitude
        const double hz = random.uniform(slowest_hz, fastest_hz);
        made.push_back({2 * kPi * hz, random.uniform(0, 2 * kPi), sd * std::sqrt(2.0 / kCount)});
    }
    return made;
}

double Flight::valueOf(const std::vector<Sway>& sways, double time_s) {
    double value = 0;
    for (const Sway& sway : sways) {
        value += sway.amplitude * std::sin(sway.rad_s * time_s + sway.phase);
    }
    return value;
}

/// Returns the curvature as flown: smoothed, so that turns begin early and end late.
double Flight::curvatureAt(double way_m) const {
    double curvature = 0;
    constexpr int kNear = 8;
    for (int i = -kNear; i <= kNear; ++i) {
        curvature += path_.curvature_per_m(way_m + 0.5 * i) / (2 * kNear + 1);
    }
    return curvature;
}

double Flight::speedAt(double way_m) const {
    const double curvature = std::max(curvatureAt(way_m), 1e-6);
    return std::min(settings_.speed_m_s, std::sqrt(kMaxLateral_m_s2 / curvature));
}

double Flight::arcLengthAt(double time_s) const {
    const double lap_m = kWayStep_m * static_cast<double>(lap_s_.size() - 1);
    const double laps = std::floor(time_s / lap_s_.back());
    const double rest_s = time_s - laps * lap_s_.back();
    const auto next = std::upper_bound(lap_s_.begin() + 1, lap_s_.end() - 1, rest_s);
    const double share = (rest_s - *(next - 1)) / (*next - *(next - 1));
    const double step = static_cast<double>(next - 1 - lap_s_.begin()) + share;
    // The last step may end beyond the lap, so distances are scaled to the lap's length.
    return path_.length_m() * (laps + kWayStep_m * step / lap_m);
}

SensorPose Flight::at(double time_s) const {
    const double way_m = arcLengthAt(time_s);
    const Eigen::Vector2d place = path_.at(way_m);
    const double heading = path_.heading_rad(way_m);

    // Follows the average ground nearby, not single bumps, and stays well above its peaks.
    double ground_m = 0, highest_m = -1e9;
    for (int i = -3; i <= 3; ++i) {
        const Eigen::Vector2d near =
            place + 1.0 * i * Eigen::Vector2d(std::cos(heading), std::sin(heading));
        const double height_m = terrain_.height_m(near.x(), near.y());
        ground_m += height_m / 7;
        highest_m = std::max(highest_m, height_m);
    }
    const double altitude_m = settings_.altitude_m + valueOf(climb_, time_s);
    const double z_m = std::max(ground_m + altitude_m, highest_m + 0.7 * settings_.altitude_m);

    const double speed = speedAt(way_m);
    const double bank_m_s2 = speed * speed * curvatureAt(way_m);
    const double roll = valueOf(roll_, time_s) - lean_ * std::atan(bank_m_s2 / kGravity_m_s2);
    const double pitch = valueOf(pitch_, time_s) + lean_ * kLeanPerSpeed_rad * speed;
    const double yaw = heading + valueOf(yaw_, time_s);
    return {{place.x(), place.y(), z_m},
            Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX())};
}

}  // namespace hagen::simulation
