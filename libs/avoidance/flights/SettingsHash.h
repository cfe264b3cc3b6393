#pragma once
#include <hagen/avoidance/LatencyProfile.h>
#include <string>

namespace hagen::avoidance {

/// Increment this number with every change to courses, world models, guidance, planners or the
/// flight itself that alters the row of any run: a table must not mix old and new runs.
/// RecordedFlights_test detects missing increments.
constexpr int kRevision = 14;

/// 16 hexadecimal digits that identify all settings of a run outside its own row: the program's
/// version, kRevision, vehicle, sensor errors, filter options, ranges and latencies.
std::string hashOfSettings(const LatencyProfile& profile);

}  // namespace hagen::avoidance
