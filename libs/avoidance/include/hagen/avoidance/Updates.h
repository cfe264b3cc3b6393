#pragma once
#include <string>

namespace hagen::avoidance {

/// What reaches the world model, and when.
///
///     scans    whole scans, each when the sensor's turn is complete: 10 Hz
///     sectors  sectors of 15 degrees, labelled by a StreamingSegmenter, each when its last packet
///              is there; the planner runs at 50 Hz, on all that came since it began the last time
enum class Updates { Scans, Sectors };

/// "scans", "sectors".
std::string nameOf(Updates updates);
/// Throws std::invalid_argument, naming the known ones.
Updates updatesFrom(const std::string& name);

}  // namespace hagen::avoidance
