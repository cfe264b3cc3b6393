#pragma once

namespace hagen::simulation {

/// The time stamp of a simulated log's first scan, at flight time 0: 2026-01-01, on a full hour [s
/// since 1970].
constexpr double kSimulatedLogStart_s = 1767225600;

}  // namespace hagen::simulation
