#pragma once
#include <filesystem>
#include <system_error>
#include <vector>

namespace hagen::base {

/// The paths of a folder's entries, sorted. Throws std::filesystem::filesystem_error if the folder
/// cannot be read.
std::vector<std::filesystem::path> entriesOf(const std::filesystem::path& folder);
/// Like entriesOf(folder), but sets `error` instead of throwing, and returns the readable entries.
std::vector<std::filesystem::path> entriesOf(const std::filesystem::path& folder,
                                             std::error_code& error);

/// Removes a file, or a folder with its contents, without following links. A missing path is not an
/// error.
std::error_code removeAll(const std::filesystem::path& path) noexcept;

}  // namespace hagen::base
