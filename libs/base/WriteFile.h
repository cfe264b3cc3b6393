#pragma once
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace hagen::base {

/// Throws std::runtime_error that names `file` and the reason (an errno) for a failed write.
[[noreturn]] inline void throwWriteError(const std::filesystem::path& file, int error_number) {
    throw std::runtime_error(file.string() + ": cannot be written" +
                             (error_number == 0 ? "; is the disk full?"
                                                : std::string(": ") + std::strerror(error_number)));
}

/// Opens a file for writing at `place`, for example an OutputPath's temporary name. Throws
/// std::runtime_error if it cannot be opened; the message names `file` and the reason.
inline std::ofstream openToWrite(const std::filesystem::path& place,
                                 const std::filesystem::path& file) {
    errno = 0;
    std::ofstream out(place, std::ios::binary);
    if (!out) throwWriteError(file, errno);
    return out;
}

/// Closes a written file. Throws std::runtime_error if not all data was written; the message names
/// the file and the reason.
inline void closeWritten(std::ofstream& out, const std::filesystem::path& file) {
    const bool is_whole = static_cast<bool>(out);
    out.clear();
    // Write again, because errno may have changed since the failure.
    if (!is_whole) out << '\n';
    errno = 0;
    out.close();
    if (!is_whole || !out) throwWriteError(file, errno);
}

/// Writes an entire file. Throws like openToWrite() and closeWritten().
inline void writeText(const std::string& text, const std::filesystem::path& place,
                      const std::filesystem::path& file) {
    std::ofstream out = openToWrite(place, file);
    out << text;
    closeWritten(out, file);
}

}  // namespace hagen::base
