#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>

namespace hagen::recordings {

/// The next bytes of a file, and room for what they unpack to. Both shrink from the front.
struct UnpackStep {
    const unsigned char* in;
    std::size_t in_size;
    unsigned char* out;
    std::size_t out_size;
};

/// A format of compression, read block by block.
class Unpacker {
 public:
    virtual ~Unpacker() = default;
    /// Unpacks until the input or the room is used up, or a member ends. False: it cannot
    /// (fault()).
    virtual bool unpack(UnpackStep& step) = 0;
    virtual const char* fault() const { return "the compressed data is corrupt"; }
    /// The most bytes that so many bytes of input can unpack to.
    virtual std::uint64_t mostOutOf(std::uint64_t packed) const = 0;
    /// Whether the input may not end here: a member has begun.
    bool isInMember() const { return is_in_member_; }

 protected:
    bool is_in_member_ = false;
};

/// The unpacker of a file that begins with these bytes: gzip, zstd, or none for anything else.
std::unique_ptr<Unpacker> unpackerFor(const unsigned char* start, std::size_t size);

}  // namespace hagen::recordings
