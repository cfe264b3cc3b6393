#pragma once

namespace hagen::simulation {

/// Timestamp of the first scan (flight time 0) of a simulated log: 2026-01-01, on a full hour [s
/// since 1970].
constexpr double kSimulatedLogStart_s = 1767225600;

}  // namespace hagen::simulation
