#pragma once

namespace hagen {

/// The longest range of a sensor that settings can name.
inline constexpr double kMaxRange_m = 1000;

}  // namespace hagen
