#include "recordings/rawlogs/PackedInput.h"
#include <sys/stat.h>
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <vector>

#include "recordings/rawlogs/Unpacker.h"

namespace hagen::recordings {
namespace {

constexpr std::size_t kPackedBytes = 1 << 17, kUnpackedBytes = 1 << 18;

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

/// The file and its buffers. Does not use zlib's gzread(), which silently stops at data that does
/// not look like another member and would thus lose the rest of a damaged log.
struct PackedInput::Stream {
    std::unique_ptr<std::FILE, CloseFile> file;
    std::vector<unsigned char> packed = std::vector<unsigned char>(kPackedBytes);
    std::vector<unsigned char> unpacked = std::vector<unsigned char>(kUnpackedBytes);
    std::size_t packed_at = 0, packed_end = 0;
    std::size_t unpacked_at = 0, unpacked_end = 0;
    std::uint64_t size = 0;  ///< file size [bytes]
    std::uint64_t taken = 0;
    bool may_hold_more = false;  ///< last block was full, so that more output may follow
    std::string fault;
    std::unique_ptr<Unpacker> unpacker;

    explicit Stream(std::FILE* opened) : file(opened) {
        struct stat status {};
        if (fstat(fileno(opened), &status) == 0) size = static_cast<std::uint64_t>(status.st_size);
        fill();
        unpacker = unpackerFor(packed.data(), packed_end);
    }

    /// Reads the next block of the file; returns false at its end.
    bool fill() {
        packed_at = 0;
        packed_end = std::fread(packed.data(), 1, packed.size(), file.get());
        if (std::ferror(file.get()) != 0) fault = "the file has a read error";
        taken += packed_end;
        return packed_end > 0;
    }

    /// Decompresses the next block; returns false at the end or on an error.
    bool unpack() {
        unpacked_at = unpacked_end = 0;
        while (unpacked_end < unpacked.size() && fault.empty()) {
            if (packed_at == packed_end && !may_hold_more && !fill()) {
                if (unpacker->isInMember() && fault.empty()) fault = "the file is truncated";
                break;
            }
            UnpackStep step{packed.data() + packed_at, packed_end - packed_at,
                            unpacked.data() + unpacked_end, unpacked.size() - unpacked_end};
            const std::size_t in_before = step.in_size, out_before = step.out_size;
            const bool is_sound = unpacker->unpack(step);
            const bool is_stuck =
                in_before > 0 && step.in_size == in_before && step.out_size == out_before;
            if (!is_sound || is_stuck) fault = unpacker->fault();
            packed_at = packed_end - step.in_size;
            unpacked_end = unpacked.size() - step.out_size;
            may_hold_more = step.out_size == 0 && unpacker->isInMember();
        }
        return unpacked_end > 0;
    }
};

PackedInput::PackedInput(const std::filesystem::path& file) {
    std::FILE* const opened = std::fopen(file.c_str(), "rb");
    if (opened == nullptr) throw std::runtime_error(file.string() + ": cannot be opened");
    stream_ = std::make_unique<Stream>(opened);
}

PackedInput::~PackedInput() = default;

std::size_t PackedInput::Read(void* buffer, std::size_t count) {
    Stream& s = *stream_;
    std::size_t done = 0;
    while (done < count) {
        if (s.unpacked_at == s.unpacked_end && !s.unpack()) break;
        const std::size_t bytes = std::min(count - done, s.unpacked_end - s.unpacked_at);
        std::memcpy(static_cast<char*>(buffer) + done, s.unpacked.data() + s.unpacked_at, bytes);
        s.unpacked_at += bytes;
        done += bytes;
    }
    position_ += done;
    return done;
}

std::uint64_t PackedInput::packedPosition() const {
    return stream_->taken - (stream_->packed_end - stream_->packed_at);
}

std::uint64_t PackedInput::packedBytes() const { return stream_->size; }

std::uint64_t PackedInput::mostBytesLeft() const {
    const Stream& s = *stream_;
    const std::uint64_t unread = s.size > s.taken ? s.size - s.taken : 0;
    const std::uint64_t packed = unread + (s.packed_end - s.packed_at);
    const std::uint64_t max = s.unpacker->mostOutOf(packed);
    const std::uint64_t ready = s.unpacked_end - s.unpacked_at;
    return max > std::numeric_limits<std::uint64_t>::max() - ready
               ? std::numeric_limits<std::uint64_t>::max()
               : max + ready;
}

int PackedInput::descriptor() const { return fileno(stream_->file.get()); }

std::string PackedInput::fault() const {
    // Return data decompressed before the error first.
    return stream_->unpacked_at == stream_->unpacked_end ? stream_->fault : "";
}

std::size_t PackedInput::Write(const void*, std::size_t) {
    throw std::logic_error("an input cannot be written");
}
std::uint64_t PackedInput::Seek(std::int64_t, TSeekOrigin) {
    throw std::logic_error("a compressed input cannot seek");
}
std::uint64_t PackedInput::getTotalBytesCount() const {
    throw std::logic_error("the uncompressed size is unknown");
}

}  // namespace hagen::recordings
