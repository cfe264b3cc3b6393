#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>

namespace hagen::recordings {

/// The next input bytes, and space for output. Both shrink from the front.
struct UnpackStep {
    const unsigned char* in;
    std::size_t in_size;
    unsigned char* out;
    std::size_t out_size;
};

/// Decompresses one format, block by block.
class Unpacker {
 public:
    virtual ~Unpacker() = default;
    /// Decompresses until the input or the space is used up, or a member ends. Returns false on an
    /// error (fault()).
    virtual bool unpack(UnpackStep& step) = 0;
    virtual const char* fault() const { return "the compressed data is corrupt"; }
    /// The maximum output size for this input size.
    virtual std::uint64_t mostOutOf(std::uint64_t packed) const = 0;
    /// True within a member, where the input must not end.
    bool isInMember() const { return is_in_member_; }

 protected:
    bool is_in_member_ = false;
};

/// Returns the unpacker for a file that starts with these bytes: gzip, zstd or uncompressed.
std::unique_ptr<Unpacker> unpackerFor(const unsigned char* start, std::size_t size);

}  // namespace hagen::recordings
