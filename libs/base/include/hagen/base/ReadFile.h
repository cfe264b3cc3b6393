#pragma once
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

namespace hagen::base {

/// Throws std::runtime_error naming what is a folder, a pipe or a device: to open a pipe may take
/// forever, and a device may have no end. What does not exist passes.
void checkIsFile(const std::filesystem::path& file);

/// Opens a file. Throws as checkIsFile(), and if it cannot be read.
std::ifstream openToRead(const std::filesystem::path& file);

/// The longest text that is read as a whole: parsers take many times its memory.
constexpr std::size_t kMostTextBytes = 256 << 20;

/// The whole text of a file. Throws std::runtime_error naming it if it cannot be read to its end (a
/// parser would take what was read for all there is), or is longer than `most_bytes`.
std::string readText(const std::filesystem::path& file, std::size_t most_bytes = kMostTextBytes);

/// Reads the next line, like std::getline(); false at the end. Throws std::runtime_error naming the
/// file if the line is longer than a megabyte, as those of files that are no text.
bool nextLine(std::ifstream& in, std::string& line, const std::filesystem::path& file);

}  // namespace hagen::base
