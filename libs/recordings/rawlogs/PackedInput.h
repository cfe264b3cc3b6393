#pragma once
#include <mrpt/io/CStream.h>
#include <filesystem>
#include <memory>
#include <string>

namespace hagen::recordings {

/// Reads a file that is uncompressed or consists of gzip members or zstd frames, as detected by
/// content. Detects truncation. (MRPT's own stream accepts truncated gzip files, and supports zstd
/// only since MRPT 3.)
class PackedInput : public mrpt::io::CStream {
 public:
    /// Throws std::runtime_error naming the file if it cannot be opened.
    explicit PackedInput(const std::filesystem::path& file);
    ~PackedInput() override;

    /// Reads up to `count` bytes, fewer at the end of the file or on an error. Returns the number
    /// of bytes read.
    std::size_t Read(void* buffer, std::size_t count) override;
    /// Number of uncompressed bytes read so far.
    std::uint64_t getPosition() const override { return position_; }
    /// Bytes of the file consumed so far.
    std::uint64_t packedPosition() const;
    /// File size when opened; the file may have been renamed or removed since.
    std::uint64_t packedBytes() const;

    /// The maximum number of uncompressed bytes that can follow, from the maximum compression ratio
    /// of the format.
    std::uint64_t mostBytesLeft() const;
    int descriptor() const;

    /// The error that stopped reading: the file is truncated or corrupt. Empty while data is left,
    /// and after a regular end.
    std::string fault() const;

    // Not supported, because the input is read once, from start to end.
    std::size_t Write(const void* buffer, std::size_t count) override;
    std::uint64_t Seek(std::int64_t offset, TSeekOrigin origin) override;
    std::uint64_t getTotalBytesCount() const override;

 private:
    struct Stream;
    std::unique_ptr<Stream> stream_;
    std::uint64_t position_ = 0;
};

}  // namespace hagen::recordings
