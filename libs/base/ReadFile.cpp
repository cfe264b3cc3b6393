#include "base/ReadFile.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace hagen::base {
namespace {

constexpr std::size_t kMaxLineLength = 1 << 20;

}  // namespace

void failAt(const std::filesystem::path& path, const std::string& what) {
    throw std::runtime_error(path.string() + ": " + what);
}

void checkIsFile(const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (std::filesystem::is_directory(status)) failAt(file, "is a folder, not a file");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        failAt(file, "is a pipe or a device; save its content to a file first");
    }
}

std::ifstream openToRead(const std::filesystem::path& file) {
    checkIsFile(file);
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        failAt(file, std::string("cannot be read") +
                         (errno == 0 ? "" : std::string(": ") + std::strerror(errno)));
    }
    return in;
}

std::string readText(const std::filesystem::path& file, std::size_t max_bytes) {
    std::ifstream in = openToRead(file);
    std::string text;
    char block[4096];
    while (in.read(block, sizeof block) || in.gcount() > 0) {
        text.append(block, static_cast<std::size_t>(in.gcount()));
        if (text.size() > max_bytes) {
            failAt(file, "is larger than " + std::to_string(max_bytes >> 20) +
                             " MiB, too large for a text file");
        }
    }
    if (in.bad()) failAt(file, "cannot be read");
    return text;
}

bool nextLine(std::ifstream& in, std::string& line, const std::filesystem::path& file) {
    line.clear();
    for (int c = in.get(); c != std::ifstream::traits_type::eof(); c = in.get()) {
        if (c == '\n') return true;
        if (line.size() == kMaxLineLength)
            failAt(file, "has a line longer than 1 MiB, so it is not a text file");
        line += static_cast<char>(c);
    }
    return !line.empty();
}

}  // namespace hagen::base
