#pragma once
#include <hagen/trials/LatencyProfile.h>
#include <string>

namespace hagen::trials {

/// Count it up with every change of courses, world models, guidance, planners or the flight itself
/// that changes the row of any run: old and new runs must not stand in one table.
/// RecordedFlights_test fails if this was forgotten.
constexpr int kRevision = 3;

/// 16 hexadecimal digits that stand for everything that makes a run what it is, except what its own
/// row says: the program's version, kRevision, vehicle, filter settings and latencies.
std::string hashOfSettings(const LatencyProfile& profile);

/// The vehicle of all runs, as JSON.
std::string vehicleText();

}  // namespace hagen::trials
