#include "recordings/bags/Unpack.h"

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>

namespace hagen::recordings {
namespace {

/// An output buffer that grows up to a limit.
class Growing {
 public:
    Growing(std::vector<std::uint8_t>& plain, std::uint64_t max) : plain_(plain), max_(max) {
        plain_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(max, 1 << 16)));
    }
    std::uint8_t* end() { return plain_.data() + used_; }
    std::size_t room() const { return plain_.size() - used_; }
    void add(std::size_t bytes) { used_ += bytes; }
    std::size_t used() const { return used_; }
    /// Enlarges the buffer; returns false at the limit.
    bool grow() {
        if (room() > 0) return true;
        if (used_ >= max_) return false;
        plain_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(max_, 2 * plain_.size())));
        return true;
    }
    void finish() { plain_.resize(used_); }

 private:
    std::vector<std::uint8_t>& plain_;
    std::uint64_t max_;
    std::size_t used_ = 0;
};

[[noreturn]] void failPacked(const std::string& why) {
    throw std::runtime_error("cannot be decompressed: " + why);
}
[[noreturn]] void failLarge() { failPacked("it is larger than it claims"); }

void unpackZstd(ByteView packed, Growing& plain) {
    const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                            &ZSTD_freeDStream);
    ZSTD_inBuffer in{packed.data, packed.size, 0};
    std::size_t due = 1;  // 0 if a frame is complete
    while (due != 0 || in.pos < in.size) {
        std::uint8_t none = 0;
        const bool has_room = plain.grow();
        ZSTD_outBuffer out{has_room ? plain.end() : &none, has_room ? plain.room() : 0, 0};
        const std::size_t before = in.pos;
        due = ZSTD_decompressStream(stream.get(), &out, &in);
        if (ZSTD_isError(due)) failPacked(ZSTD_getErrorName(due));
        plain.add(out.pos);
        if (due == 0 || out.pos > 0 || in.pos > before) continue;
        if (!has_room) failLarge();
        failPacked("it is truncated");
    }
}

void unpackLz4(ByteView packed, Growing& plain) {
    LZ4F_dctx* raw = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&raw, LZ4F_VERSION))) throw std::bad_alloc();
    const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
        raw, &LZ4F_freeDecompressionContext);
    std::size_t at = 0, due = 1;
    while (due != 0 || at < packed.size) {
        std::uint8_t none = 0;
        const bool has_room = plain.grow();
        std::size_t out = has_room ? plain.room() : 0, in = packed.size - at;
        due = LZ4F_decompress(raw, has_room ? plain.end() : &none, &out, packed.data + at, &in,
                              nullptr);
        if (LZ4F_isError(due)) failPacked(LZ4F_getErrorName(due));
        plain.add(out);
        at += in;
        if (due == 0 || out > 0 || in > 0) continue;
        if (!has_room) failLarge();
        failPacked("it is truncated");
    }
}

void unpackBz2(ByteView packed, Growing& plain) {
    if (packed.size > std::numeric_limits<unsigned>::max()) failPacked("it is too large");
    bz_stream stream{};
    if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
    const std::unique_ptr<bz_stream, decltype(&BZ2_bzDecompressEnd)> end(&stream,
                                                                         &BZ2_bzDecompressEnd);
    // The library does not modify its input.
    stream.next_in = reinterpret_cast<char*>(const_cast<std::uint8_t*>(packed.data));
    stream.avail_in = static_cast<unsigned>(packed.size);
    for (int state = BZ_OK; state != BZ_STREAM_END;) {
        char none = 0;
        const bool has_room = plain.grow();
        const auto room = static_cast<unsigned>(has_room ? plain.room() : 0);
        stream.next_out = has_room ? reinterpret_cast<char*>(plain.end()) : &none;
        stream.avail_out = room;
        const unsigned in = stream.avail_in;
        state = BZ2_bzDecompress(&stream);
        if (state != BZ_OK && state != BZ_STREAM_END) {
            failPacked("its bzip2 data are corrupt (" + std::to_string(state) + ")");
        }
        const unsigned out = room - stream.avail_out;
        plain.add(out);
        if (state == BZ_STREAM_END || out > 0 || stream.avail_in < in) continue;
        if (!has_room) failLarge();
        failPacked("it is truncated");
    }
    if (stream.avail_in > 0) failPacked("extra data after its bzip2 data");
}

}  // namespace

ByteView unpack(const std::string& compression, ByteView packed, std::uint64_t size,
                std::vector<std::uint8_t>& plain) {
    if (size > kMaxUnpackedBytes) {
        failPacked("it claims a size of " + std::to_string(size) + " bytes, more than " +
                   std::to_string(kMaxUnpackedBytes));
    }
    const auto checkSize = [&](std::size_t found) {
        if (found == size) return;
        failPacked("it has " + std::to_string(found) + " bytes, but claims " +
                   std::to_string(size));
    };
    if (compression.empty() || compression == "none") {
        checkSize(packed.size);
        return packed;
    }
    Growing growing(plain, size);
    if (compression == "zstd") {
        unpackZstd(packed, growing);
    } else if (compression == "lz4") {
        unpackLz4(packed, growing);
    } else if (compression == "bz2") {
        unpackBz2(packed, growing);
    } else {
        failPacked("its compression '" + compression.substr(0, 32) +
                   "' is not supported (none, zstd, lz4, bz2)");
    }
    growing.finish();
    checkSize(plain.size());
    return {plain.data(), plain.size()};
}

void unpackZstd(ByteView packed, std::vector<std::uint8_t>& plain) {
    Growing growing(plain, kMaxUnpackedBytes);
    unpackZstd(packed, growing);
    growing.finish();
}

}  // namespace hagen::recordings
