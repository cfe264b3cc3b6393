#pragma once
#include <filesystem>
#include <string>

#include "Recording.h"

namespace hagen::replays {

/// A page that plays a recording in 3D, and needs nothing else.
std::string replayPage(const Recording& recording);

/// The end of a recording as a scene for SceneViewer3D: what truly stood and moved, what the model
/// held, the last scan, the way flown, start and goal. Written at `place`, such as an OutputPath's
/// temporary name. Throws std::runtime_error, naming `file`, where writing fails.
void writeReplayScene(const Recording& recording, const std::filesystem::path& place,
                      const std::filesystem::path& file);

}  // namespace hagen::replays
