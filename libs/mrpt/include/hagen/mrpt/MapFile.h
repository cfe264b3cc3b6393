#pragma once
#include <octomap/OcTree.h>
#include <filesystem>

namespace hagen::observations {

/// True if the name has a map's extension: .bt, .ot, .3Dscene.
bool isMapFile(const std::filesystem::path& file);
/// Throws std::runtime_error if it does not; the message names the file and the extensions.
void checkMapFile(const std::filesystem::path& file);

/// Writes the map in the format of the file's ending: .bt (occupied or free), .ot (probabilities),
/// .3Dscene (occupied voxels, for SceneViewer3D). Throws std::runtime_error for any other ending
/// and if writing fails; the message names the file. Writes in place: callers use OutputPath.
void saveMap(const octomap::OcTree& tree, const std::filesystem::path& file);
/// The same into a file of any name, in the format of `named`.
void saveMap(const octomap::OcTree& tree, const std::filesystem::path& file,
             const std::filesystem::path& named);
/// The same without a copy of the tree: its inner nodes are brought up to date, equal children
/// become one, and of a .bt all voxels become occupied or free.
void saveMapInPlace(octomap::OcTree& tree, const std::filesystem::path& file,
                    const std::filesystem::path& named);

}  // namespace hagen::observations
