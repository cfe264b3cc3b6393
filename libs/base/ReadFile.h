#pragma once
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

namespace hagen::base {

/// Throws std::runtime_error with the message "path: what".
[[noreturn]] void failAt(const std::filesystem::path& path, const std::string& what);

/// Throws std::runtime_error for a folder, a pipe or a device: opening a pipe may block, and a
/// device may be endless. Missing files pass.
void checkIsFile(const std::filesystem::path& file);

/// Opens a file. Throws like checkIsFile(), and if the file cannot be read.
std::ifstream openToRead(const std::filesystem::path& file);

/// Size limit for whole texts: parsers need several times as much memory.
constexpr std::size_t kMaxTextBytes = 256 << 20;

/// Reads a whole file. Throws std::runtime_error naming it if it cannot be read to its end, or is
/// larger than `max_bytes`.
std::string readText(const std::filesystem::path& file, std::size_t max_bytes = kMaxTextBytes);

/// Reads the next line, like std::getline(); false at the end. Throws std::runtime_error naming the
/// file if the line is longer than 1 MiB, as in binary files.
bool nextLine(std::ifstream& in, std::string& line, const std::filesystem::path& file);

}  // namespace hagen::base
