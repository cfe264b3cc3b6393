#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>

struct archive;

namespace hagen::recordings {

/// Decompresses zstd frames, an LZ4 frame or bzip2 data. Functions throw std::runtime_error with
/// the reason if data are invalid or truncated.
class Unpacker {
 public:
    /// `descriptor`: a file, owned by the caller, at its start.
    explicit Unpacker(int descriptor);
    /// `bytes` must outlive this object.
    Unpacker(const std::uint8_t* bytes, std::size_t size);

    /// Reads up to `count` bytes, fewer at the end. Returns the number of bytes read.
    std::size_t read(void* to, std::size_t count);
    /// Bytes of the input decompressed so far.
    std::uint64_t consumed() const;

 private:
    void start(int opened);

    struct Free {
        void operator()(archive* reader) const;
    };
    std::unique_ptr<archive, Free> reader_;
    bool is_at_end_ = false;
};

}  // namespace hagen::recordings
