#pragma once
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace hagen::base {

/// The paths of a folder's entries, sorted. Throws std::filesystem::filesystem_error if the folder
/// cannot be read.
std::vector<std::filesystem::path> entriesOf(const std::filesystem::path& folder);
/// Like entriesOf(folder), but sets `error` instead of throwing, and returns the readable entries.
std::vector<std::filesystem::path> entriesOf(const std::filesystem::path& folder,
                                             std::error_code& error);

/// The last name of a path, even with a trailing separator ("folder/").
inline std::string lastNameOf(const std::filesystem::path& path) {
    return (path.has_filename() ? path : path.parent_path()).filename().string();
}

}  // namespace hagen::base
