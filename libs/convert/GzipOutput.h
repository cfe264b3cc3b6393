#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

namespace hagen::convert {

using Bytes = std::vector<std::uint8_t>;

/// Compresses bytes into one gzip member (level 1, like MRPT's tools). Concatenated members form
/// one gzip file. Thread-safe.
void packGzipMember(const Bytes& plain, Bytes& packed);

/// Writes a gzip file member by member and checks every write. MRPT's stream does not report a full
/// disk.
class GzipOutput {
 public:
    /// Throws std::runtime_error naming the file if it cannot be opened.
    explicit GzipOutput(const std::filesystem::path& file);

    /// Appends a compressed member. Throws std::runtime_error with the system's error message; the
    /// file then ends with its last complete member. Do not write afterwards.
    void write(const Bytes& member);
    /// Closes the file. Throws like write().
    void close();

 private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Close> file_;
    long whole_ = 0;  ///< bytes of the complete members
};

}  // namespace hagen::convert
