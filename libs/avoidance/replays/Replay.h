#pragma once
#include <string>

#include "avoidance/replays/FlightRecording.h"

namespace hagen::avoidance {

/// A self-contained HTML page that plays a recording in 3D.
std::string replayPage(const FlightRecording& recording);

}  // namespace hagen::avoidance
