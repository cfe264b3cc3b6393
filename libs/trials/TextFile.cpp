#include "TextFile.h"

#include <hagen/base/ReadFile.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace hagen::trials {

namespace fs = std::filesystem;

std::vector<std::string> linesOf(const fs::path& file) {
    std::ifstream in = base::openToRead(file);
    std::vector<std::string> lines;
    for (std::string line; base::nextLine(in, line, file);) lines.push_back(line);
    if (in.bad() || !in.eof()) throw std::runtime_error(file.string() + ": cannot be read");
    return lines;
}

std::string placeOf(const fs::path& file, std::size_t line) {
    return file.string() + ":" + std::to_string(line + 1);
}

void failWith(const fs::path& file, const std::string& what) {
    throw std::runtime_error(file.string() + ": " + what + ": " + std::strerror(errno));
}

}  // namespace hagen::trials
