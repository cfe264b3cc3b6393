#pragma once
#include <mrpt/io/CStream.h>
#include <filesystem>
#include <memory>
#include <string>

namespace hagen::recordings {

/// Reads a file that is uncompressed or consists of one or more gzip members or zstd frames, by
/// its content, and detects truncation. MRPT's own stream takes a truncated gzip file for
/// a complete one, and before MRPT 3 knows no zstd.
class PackedInput : public mrpt::io::CStream {
 public:
    /// Throws std::runtime_error naming the file if it cannot be opened.
    explicit PackedInput(const std::filesystem::path& file);
    ~PackedInput() override;

    /// Reads up to `count` bytes; fewer at the end of the file or at a fault. Returns their number.
    std::size_t Read(void* buffer, std::size_t count) override;
    /// Uncompressed bytes read so far.
    std::uint64_t getPosition() const override { return position_; }
    /// Bytes of the file consumed so far.
    std::uint64_t packedPosition() const;
    /// Bytes of the file when it was opened; it may have been renamed or removed since.
    std::uint64_t packedBytes() const;

    /// The most bytes (uncompressed) that can follow: of compressed data, what its format can hold
    /// in the rest of the file.
    std::uint64_t mostBytesLeft() const;
    /// The open file.
    int descriptor() const;

    /// Why reading stopped: the file is truncated or corrupt. Empty while there is data left, and
    /// after a regular end.
    std::string fault() const;

    // Not supported: the input is read once, from start to end.
    std::size_t Write(const void* buffer, std::size_t count) override;
    std::uint64_t Seek(std::int64_t offset, TSeekOrigin origin) override;
    std::uint64_t getTotalBytesCount() const override;

 private:
    struct Stream;
    std::unique_ptr<Stream> stream_;
    std::uint64_t position_ = 0;
};

}  // namespace hagen::recordings
