#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::trials {

/// Throws std::runtime_error, naming the file.
std::vector<std::string> linesOf(const std::filesystem::path& file);

/// "FILE:3" of the line with index 2.
std::string placeOf(const std::filesystem::path& file, std::size_t line);

/// Throws std::runtime_error: "FILE: WHAT: why", by errno.
[[noreturn]] void failWith(const std::filesystem::path& file, const std::string& what);

}  // namespace hagen::trials
