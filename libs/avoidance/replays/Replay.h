#pragma once
#include <filesystem>
#include <string>

#include "avoidance/replays/FlightRecording.h"

namespace hagen::avoidance {

/// A self-contained HTML page that plays a recording in 3D.
std::string replayPage(const FlightRecording& recording);

/// The end of a recording as a scene for SceneViewer3D: the true scene, the model's obstacles, the
/// last scan, the path flown, start and goal. Written to `place`, such as an OutputPath's temporary
/// name. Throws std::runtime_error, naming `file`, if writing fails.
void writeReplayScene(const FlightRecording& recording, const std::filesystem::path& place,
                      const std::filesystem::path& file);

}  // namespace hagen::avoidance
