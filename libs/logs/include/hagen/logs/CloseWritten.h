#pragma once
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace hagen {

/// Closes a file that was written. Throws std::runtime_error, naming it, where not all arrived.
inline void closeWritten(std::ofstream& out, const std::filesystem::path& file) {
    out.close();
    if (!out) throw std::runtime_error(file.string() + ": cannot be written; is the disk full?");
}

}  // namespace hagen
