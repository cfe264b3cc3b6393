#pragma once
#include <octomap/OcTree.h>
#include <filesystem>

namespace hagen::observations {

/// Throws std::runtime_error, naming the file and the extensions, unless the extension is a map's:
/// .bt, .ot, .3Dscene.
void checkMapFile(const std::filesystem::path& file);

/// Writes the map in the format of the extension: .bt (occupied or free), .ot (probabilities),
/// .3Dscene (occupied voxels, for SceneViewer3D). Throws std::runtime_error, naming the file, for
/// other extensions, or if writing fails. Does not write atomically: callers use OutputPath.
void saveMap(const octomap::OcTree& tree, const std::filesystem::path& file);
/// Like saveMap(), but without copying the tree, and to an arbitrary file name, in the format of
/// `named`. Updates inner nodes and prunes the tree; for .bt, makes all voxels occupied or free.
void saveMapInPlace(octomap::OcTree& tree, const std::filesystem::path& file,
                    const std::filesystem::path& named);

}  // namespace hagen::observations
