#pragma once
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace hagen::base {

/// The whole text of a file. Throws std::runtime_error naming it if it cannot be read to its end: a
/// parser would take what was read for all there is.
inline std::string readText(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string text;
    char block[4096];
    while (in.read(block, sizeof block) || in.gcount() > 0) {
        text.append(block, static_cast<std::size_t>(in.gcount()));
    }
    if (!in.is_open() || in.bad()) throw std::runtime_error(file.string() + ": cannot be read");
    return text;
}

}  // namespace hagen::base
