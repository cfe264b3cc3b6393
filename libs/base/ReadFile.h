#pragma once
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

namespace hagen::base {

/// Throws std::runtime_error with the message "PATH: WHAT".
[[noreturn]] void failAt(const std::filesystem::path& path, const std::string& what);

/// Throws std::runtime_error if the path is a folder, a pipe (opening it may block) or a device (it
/// may be endless). Accepts missing files.
void checkIsFile(const std::filesystem::path& file);

/// Opens a file. Throws std::runtime_error if checkIsFile() does or if the file cannot be read.
std::ifstream openToRead(const std::filesystem::path& file);

/// Size limit of files read as a whole: parsers need several times as much memory.
constexpr std::size_t kMaxTextBytes = 256 << 20;

/// Reads a whole file. Throws std::runtime_error, naming the file, if it cannot be read to its end
/// or is larger than `max_bytes`.
std::string readText(const std::filesystem::path& file, std::size_t max_bytes = kMaxTextBytes);

/// Reads the next line like std::getline(); returns false at the end. Throws std::runtime_error,
/// naming the file, if the line is longer than 1 MiB, as in binary files.
bool nextLine(std::ifstream& in, std::string& line, const std::filesystem::path& file);

}  // namespace hagen::base
