#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

namespace hagen::logs {

using Bytes = std::vector<std::uint8_t>;

/// Packs bytes as a gzip member of their own (level 1, what MRPT's tools write). Members one after
/// the other are one gzip file, whose readers see no seam. May be called on several threads at
/// once.
void packGzipMember(const Bytes& plain, Bytes& packed);

/// Writes a gzip file member by member, and knows whether all of it arrived. MRPT's own stream does
/// not say when the disk is full.
class GzipOutput {
 public:
    /// Throws std::runtime_error, naming the file, where it cannot be opened.
    explicit GzipOutput(const std::filesystem::path& file);

    /// Appends a packed member. Throws std::runtime_error, saying why, where the system refuses.
    void write(const Bytes& member);
    /// Ends the file. Throws as write() does.
    void close();

 private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace hagen::logs
