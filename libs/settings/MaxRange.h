#pragma once

namespace hagen {

/// The highest range limit that settings may give a sensor.
inline constexpr double kMaxRange_m = 1000;

}  // namespace hagen
