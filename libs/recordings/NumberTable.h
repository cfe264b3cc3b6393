#pragma once
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace hagen::recordings {

struct NumberLine {
    std::size_t line;  ///< 1-based
    std::vector<double> numbers;
};

/// Reads a text file of numbers, up to a maximum number of lines. Skips empty lines and lines that
/// start with '#'. Throws std::runtime_error naming file and line if the file cannot be read, or if
/// a line contains anything but finite numbers.
std::vector<NumberLine> readNumberTable(
    const std::filesystem::path& file,
    std::size_t max_lines = std::numeric_limits<std::size_t>::max());

/// Throws std::runtime_error naming file and line unless the line has `columns` numbers.
void checkColumns(const std::filesystem::path& file, const NumberLine& line, std::size_t columns,
                  const std::string& what);

}  // namespace hagen::recordings
