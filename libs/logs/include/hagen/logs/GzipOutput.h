#pragma once
#include <mrpt/io/CStream.h>
#include <filesystem>
#include <string>

struct gzFile_s;

namespace hagen {

/// Writes a gzipped file (level 1, what MRPT's own tools write), and knows whether all of it
/// arrived. MRPT's own stream does not say when the disk is full.
class GzipOutput : public mrpt::io::CStream {
 public:
    /// Throws std::runtime_error, naming the file, where it cannot be opened.
    explicit GzipOutput(const std::filesystem::path& file);
    ~GzipOutput() override;
    GzipOutput(const GzipOutput&) = delete;
    GzipOutput& operator=(const GzipOutput&) = delete;

    /// Throws std::runtime_error, saying why, where the system refuses. Bytes are packed first, so
    /// that a refusal may come some entries late, or with close() alone.
    std::size_t Write(const void* buffer, std::size_t count) override;
    /// Ends the file. Throws as Write() does.
    void close();

    /// Unpacked bytes written so far.
    std::uint64_t getPosition() const override { return position_; }

    // Not of an output that is written once, from its start to its end.
    std::size_t Read(void* buffer, std::size_t count) override;
    std::uint64_t Seek(std::int64_t offset, TSeekOrigin origin) override;
    std::uint64_t getTotalBytesCount() const override;

 private:
    std::filesystem::path path_;
    gzFile_s* file_;
    std::uint64_t position_ = 0;
};

}  // namespace hagen
