#pragma once
#include <isa-l/igzip_lib.h>
#include <mrpt/io/CStream.h>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "recordings/Unpacker.h"

namespace hagen::recordings {

/// Reads a file that is uncompressed or consists of gzip members or zstd frames, as detected by
/// content. Detects truncation. (MRPT's own stream accepts truncated gzip files, and supports zstd
/// only since MRPT 3.)
class PackedInput : public mrpt::io::CStream {
 public:
    /// Throws std::runtime_error naming the file if it cannot be opened.
    explicit PackedInput(const std::filesystem::path& file);

    /// Reads up to `count` bytes, fewer at the end of the file or on an error. Returns the number
    /// of bytes read.
    std::size_t Read(void* buffer, std::size_t count) override;
    /// Number of uncompressed bytes read so far.
    std::uint64_t getPosition() const override { return position_; }
    /// Bytes of the file consumed so far.
    std::uint64_t packedPosition() const;
    /// File size when opened; the file may have been renamed or removed since.
    std::uint64_t packedBytes() const { return size_; }
    int descriptor() const { return fileno(file_.get()); }

    /// The error that stopped reading: the file is truncated or corrupt. Empty while data is left,
    /// and after a regular end.
    const std::string& fault() const { return fault_; }

    // Not supported, because the input is read once, from start to end.
    std::size_t Write(const void*, std::size_t) override { throw std::logic_error("read-only"); }
    std::uint64_t Seek(std::int64_t, TSeekOrigin) override { throw std::logic_error("no seek"); }
    std::uint64_t getTotalBytesCount() const override { throw std::logic_error("no size"); }

 private:
    std::size_t readGzip(unsigned char* to, std::size_t count);

    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Close> file_;
    std::vector<unsigned char> packed_;
    inflate_state gzip_{};
    bool is_gzip_ = false, is_in_member_ = false;
    std::optional<Unpacker> zstd_;
    std::uint64_t size_ = 0, position_ = 0;
    std::string fault_;
};

}  // namespace hagen::recordings
