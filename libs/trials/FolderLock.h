#pragma once
#include <filesystem>
#include <memory>

namespace hagen::trials {

/// Locks a folder against other programs of ours until the last copy of the returned value is gone,
/// and until all child processes are that were started meanwhile: they inherit the lock. Throws
/// std::runtime_error, naming the folder, if another program holds it.
std::shared_ptr<const void> lockFolder(const std::filesystem::path& folder);

}  // namespace hagen::trials
