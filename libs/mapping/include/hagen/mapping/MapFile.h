#pragma once
#include <octomap/OcTree.h>
#include <filesystem>

namespace hagen::mapping {

/// Whether the name ends as that of a map: .bt, .ot, .3Dscene.
bool isMapFile(const std::filesystem::path& file);
/// Throws std::runtime_error, naming the file and the endings, where it does not.
void checkMapFile(const std::filesystem::path& file);

/// Writes the map by the file's ending: .bt (occupied or free), .ot (probabilities), .3Dscene (what
/// is occupied, for SceneViewer3D). Throws std::runtime_error, naming the file, for any other, and
/// where writing fails. Writes in place: callers use OutputPath.
void saveMap(const octomap::OcTree& tree, const std::filesystem::path& file);
/// The same into a file of any name, as if it were `named`.
void saveMap(const octomap::OcTree& tree, const std::filesystem::path& file,
             const std::filesystem::path& named);

}  // namespace hagen::mapping
