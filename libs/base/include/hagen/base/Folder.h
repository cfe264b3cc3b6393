#pragma once
#include <filesystem>
#include <system_error>
#include <vector>

namespace hagen::base {

/// The paths of a folder's entries, sorted. Throws std::filesystem::filesystem_error if the folder
/// cannot be read.
std::vector<std::filesystem::path> entriesOf(const std::filesystem::path& folder);
/// Those that can be read; `error` says why the others cannot.
std::vector<std::filesystem::path> entriesOf(const std::filesystem::path& folder,
                                             std::error_code& error);

}  // namespace hagen::base
