#pragma once
#include <filesystem>
#include <system_error>
#include <vector>

/// Folders, listed and removed without std::filesystem's iterators: those of libstdc++ end the
/// program when memory runs out between two entries.
namespace hagen::base {

/// The paths of a folder's entries, sorted. Throws std::filesystem::filesystem_error naming the
/// folder if it cannot be read to its end.
std::vector<std::filesystem::path> entriesOf(const std::filesystem::path& folder);
/// Those that can be read; `error` says why the others cannot.
std::vector<std::filesystem::path> entriesOf(const std::filesystem::path& folder,
                                             std::error_code& error);

/// Removes a file, or a folder and all in it; links are not followed. What does not exist is no
/// error.
std::error_code removeAll(const std::filesystem::path& path) noexcept;

/// Keeps a file descriptor for removeAll(): what was begun can be removed also where a process has
/// no other left.
void reserveForRemoval() noexcept;

}  // namespace hagen::base
