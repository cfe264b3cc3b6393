#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::logs {

/// A line of a text file and its numbers.
struct NumberLine {
    std::size_t line;  ///< counted from 1
    std::vector<double> numbers;
};

/// Reads a text file of numbers. Empty lines, and those that start with '#', are passed over.
/// Throws std::runtime_error, naming file and line, where it cannot be read, or a line holds
/// anything but finite numbers.
std::vector<NumberLine> readNumberTable(const std::filesystem::path& file);

/// Throws std::runtime_error, naming file and line, where the line has not `columns` numbers.
void checkColumns(const std::filesystem::path& file, const NumberLine& line, std::size_t columns,
                  const std::string& what);

}  // namespace hagen::logs
