#pragma once

namespace hagen {

constexpr double kPi = 3.14159265358979323846;
constexpr double kTurn_rad = 2 * kPi;

/// Angles are radians in code and degrees in files and flags.
constexpr double radians(double degrees) { return degrees * (kPi / 180.0); }
constexpr double degrees(double radians) { return radians * (180.0 / kPi); }

}  // namespace hagen
