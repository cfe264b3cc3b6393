#include "simulation/BeamDirections.h"

#include <hagen/scan/Angle.h>
#include <algorithm>
#include <cmath>

namespace hagen::simulation {
namespace {

/// A laser's direction within a firing: its elevation, and the rotation since the firing started.
struct LaserDirection {
    float elevation_rad, sine, cosine;
    float turn_sine, turn_cosine;
    float turn_rad;
    std::uint8_t row;
};

std::vector<LaserDirection> laserDirections(const SensorModel& sensor,
                                            const FiringPattern& pattern) {
    std::vector<LaserDirection> lasers;
    for (std::size_t laser = 0; laser < pattern.row_of_laser.size(); ++laser) {
        const std::uint8_t row = pattern.row_of_laser[laser];
        const float elevation = sensor.elevations_rad[row];
        const double turn_rad = -radians(pattern.azimuthStep_deg()) * static_cast<double>(laser) *
                                pattern.laser_period_us / pattern.firing_period_us;
        lasers.push_back({elevation, std::sin(elevation), std::cos(elevation),
                          static_cast<float>(std::sin(turn_rad)),
                          static_cast<float>(std::cos(turn_rad)), static_cast<float>(turn_rad),
                          row});
    }
    return lasers;
}

float wrapped(float angle_rad) {
    const auto pi = static_cast<float>(kPi);
    if (angle_rad > pi) return angle_rad - 2 * pi;
    return angle_rad <= -pi ? angle_rad + 2 * pi : angle_rad;
}

DirectionsOfFiring directionsOfRings(const SensorModel& sensor, const FiringPattern& pattern) {
    return [lasers = laserDirections(sensor, pattern), step_deg = pattern.azimuthStep_deg()](
               int firing, std::vector<BeamDirection>& directions) {
        const double azimuth = -radians(kFirstAzimuth_deg + firing * step_deg);
        const auto sine = static_cast<float>(std::sin(azimuth));
        const auto cosine = static_cast<float>(std::cos(azimuth));
        const auto first_rad = static_cast<float>(std::remainder(azimuth, 2 * kPi));
        for (std::size_t i = 0; i < lasers.size(); ++i) {
            const LaserDirection& l = lasers[i];
            directions[i] = {{l.cosine * (cosine * l.turn_cosine - sine * l.turn_sine),
                              l.cosine * (sine * l.turn_cosine + cosine * l.turn_sine), l.sine},
                             wrapped(first_rad + l.turn_rad),
                             l.elevation_rad,
                             l.row};
        }
    };
}

struct Angles {
    double azimuth_deg, elevation_deg;
};

double fraction(double value) { return value - std::floor(value); }

/// Rises from 0 to 1 and falls back, once per unit.
double triangle(double value) { return 1 - std::abs(2 * fraction(value) - 1); }

Angles anglesOfMid360(double time_s, int line) {
    return {kFirstAzimuth_deg - 360 * fraction(105 * std::sqrt(3.0) * time_s),
            -7.2 + 60.4 / 4 * (line + triangle(10 * std::sqrt(2.0) * time_s))};
}

Angles anglesOfAvia(double time_s, int line) {
    const double reach_deg = 35.2 * std::cos(2 * kPi * 80 * std::sqrt(2.0) * time_s);
    const double turn_rad = 2 * kPi * 10 * std::sqrt(7.0) * time_s;
    return {reach_deg * std::cos(turn_rad),
            reach_deg * std::sin(turn_rad) + 6.8 / 5 * (line - 2.5)};
}

Angles anglesOfHap(double time_s, int line) {
    return {60 - 120 * triangle(75 * std::sqrt(3.0) * time_s),
            -12.5 + 25.0 / 4 * (line + triangle(20 * std::sqrt(2.0) * time_s))};
}

auto anglesOf(const SensorModel& sensor) {
    if (sensor.name == "Avia") return anglesOfAvia;
    return sensor.name == "HAP" ? anglesOfHap : anglesOfMid360;
}

DirectionsOfFiring directionsOfSweeps(const SensorModel& sensor, const FiringPattern& pattern,
                                      double time_s) {
    return [sensor, pattern, time_s, angles_at = anglesOf(sensor)](
               int firing, std::vector<BeamDirection>& directions) {
        for (int line = 0; line < pattern.lasers; ++line) {
            const double at_s = time_s + 1e-6 * (firing * pattern.firing_period_us +
                                                 line * pattern.laser_period_us);
            const Angles angles = angles_at(at_s, line);
            const double azimuth_rad = std::remainder(radians(angles.azimuth_deg), 2 * kPi);
            const double elevation_rad = radians(angles.elevation_deg);
            const double level = std::cos(elevation_rad);
            const auto elevation = static_cast<float>(elevation_rad);
            directions[static_cast<std::size_t>(line)] = {
                Eigen::Vector3d(level * std::cos(azimuth_rad), level * std::sin(azimuth_rad),
                                std::sin(elevation_rad))
                    .cast<float>(),
                static_cast<float>(azimuth_rad), elevation,
                static_cast<std::uint8_t>(sensor.nearestRow(elevation))};
        }
    };
}

}  // namespace

DirectionsOfFiring directionsOfScan(const SensorModel& sensor, const FiringPattern& pattern,
                                    double time_s) {
    return sensor.has_rings ? directionsOfRings(sensor, pattern)
                            : directionsOfSweeps(sensor, pattern, time_s);
}

}  // namespace hagen::simulation
