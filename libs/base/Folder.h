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

/// Removes a file, or a folder and all in it; does not follow links. A missing path is no error.
std::error_code removeAll(const std::filesystem::path& path) noexcept;

}  // namespace hagen::base
