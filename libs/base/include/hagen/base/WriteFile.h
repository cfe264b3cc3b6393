#pragma once
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace hagen::base {

/// Throws std::runtime_error: `file` cannot be written, and why as errno tells.
[[noreturn]] inline void failToWrite(const std::filesystem::path& file, int error_number) {
    throw std::runtime_error(file.string() + ": cannot be written" +
                             (error_number == 0 ? "; is the disk full?"
                                                : std::string(": ") + std::strerror(error_number)));
}

/// Opens a file to be written at `place`, such as an OutputPath's temporary name. Throws
/// std::runtime_error, naming `file` and why, where that cannot be.
inline std::ofstream openToWrite(const std::filesystem::path& place,
                                 const std::filesystem::path& file) {
    errno = 0;
    std::ofstream out(place, std::ios::binary);
    if (!out) failToWrite(file, errno);
    return out;
}

/// Closes a file that was written. Throws std::runtime_error, naming it and why, where not all
/// arrived.
inline void closeWritten(std::ofstream& out, const std::filesystem::path& file) {
    const bool is_whole = static_cast<bool>(out);
    out.clear();
    // What failed earlier is tried once more: errno may be of something else since.
    if (!is_whole) out << '\n';
    errno = 0;
    out.close();
    if (!is_whole || !out) failToWrite(file, errno);
}

/// Writes all of a file. Throws as openToWrite() and closeWritten() do.
inline void writeText(const std::string& text, const std::filesystem::path& place,
                      const std::filesystem::path& file) {
    std::ofstream out = openToWrite(place, file);
    out << text;
    closeWritten(out, file);
}

}  // namespace hagen::base
