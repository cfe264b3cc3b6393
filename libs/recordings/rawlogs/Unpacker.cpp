#include "recordings/rawlogs/Unpacker.h"

#include <zlib.h>
#include <zstd.h>
#include <zstd_errors.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <new>

namespace hagen::recordings {
namespace {

constexpr std::uint64_t kMaxZeros = 256 << 20;  // more zeros are not padding and take too long

/// Decompresses concatenated gzip members.
class GzipUnpacker : public Unpacker {
 public:
    GzipUnpacker() {
        constexpr int kGzipOnly = 31;
        if (inflateInit2(&inflater_, kGzipOnly) != Z_OK) throw std::bad_alloc();
    }
    ~GzipUnpacker() override { inflateEnd(&inflater_); }
    GzipUnpacker(const GzipUnpacker&) = delete;
    GzipUnpacker& operator=(const GzipUnpacker&) = delete;

    bool unpack(UnpackStep& step) override {
        // Skips zero padding after the last member, as on tapes; gzip does the same.
        if (!is_in_member_ && has_member_) {
            while (step.in_size > 0 && *step.in == 0) {
                ++step.in;
                --step.in_size;
                if (++zeros_ > kMaxZeros) return false;
            }
            if (step.in_size == 0) return true;
        }
        is_in_member_ = has_member_ = true;
        inflater_.next_in = const_cast<unsigned char*>(step.in);  // not modified
        inflater_.avail_in = static_cast<unsigned>(step.in_size);
        inflater_.next_out = step.out;
        inflater_.avail_out = static_cast<unsigned>(step.out_size);
        const int code = inflate(&inflater_, Z_NO_FLUSH);
        step = {inflater_.next_in, inflater_.avail_in, inflater_.next_out, inflater_.avail_out};
        if (code == Z_STREAM_END) {
            is_in_member_ = false;  // the end, or another member, must follow
            inflateReset(&inflater_);
            return true;
        }
        return code == Z_OK || code == Z_BUF_ERROR;  // Z_BUF_ERROR: no progress possible
    }

    std::uint64_t mostOutOf(std::uint64_t packed) const override {
        constexpr std::uint64_t kDeflatesBest = 1032;  // 258 bytes from two bits
        constexpr std::uint64_t kHeld = 1 << 16;       // buffered by zlib
        return kDeflatesBest * std::min(packed, std::uint64_t{1} << 48) + kHeld;
    }

 private:
    z_stream inflater_{};
    bool has_member_ = false;
    std::uint64_t zeros_ = 0;  ///< number of zeros after members
};

/// Decompresses concatenated Zstandard frames.
class ZstdUnpacker : public Unpacker {
 public:
    ZstdUnpacker() : context_(ZSTD_createDCtx()) {
        if (!context_) throw std::bad_alloc();
    }

    bool unpack(UnpackStep& step) override {
        ZSTD_inBuffer in{step.in, step.in_size, 0};
        ZSTD_outBuffer out{step.out, step.out_size, 0};
        const std::size_t code = ZSTD_decompressStream(context_.get(), &out, &in);
        step = {step.in + in.pos, step.in_size - in.pos, step.out + out.pos,
                step.out_size - out.pos};
        if (ZSTD_isError(code) != 0) {
            is_too_large_ = ZSTD_getErrorCode(code) == ZSTD_error_frameParameter_windowTooLarge;
            return false;
        }
        is_in_member_ = code != 0;
        return true;
    }

    const char* fault() const override {
        return is_too_large_
                   ? "it was compressed with a window of more than 128 MiB; decompress it "
                     "first (zstd -d --long=31)"
                   : Unpacker::fault();
    }

    std::uint64_t mostOutOf(std::uint64_t) const override {
        return std::numeric_limits<std::uint64_t>::max();  // a block may repeat a byte 128 Ki times
    }

 private:
    struct Free {
        void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
    };
    std::unique_ptr<ZSTD_DCtx, Free> context_;
    bool is_too_large_ = false;
};

/// Copies an uncompressed file.
class Copier : public Unpacker {
 public:
    bool unpack(UnpackStep& step) override {
        const std::size_t bytes = std::min(step.in_size, step.out_size);
        std::memcpy(step.out, step.in, bytes);
        step = {step.in + bytes, step.in_size - bytes, step.out + bytes, step.out_size - bytes};
        return true;
    }

    std::uint64_t mostOutOf(std::uint64_t packed) const override { return packed; }
};

template <std::size_t N>
bool startsWith(const unsigned char* start, std::size_t size, const unsigned char (&magic)[N]) {
    return size >= N && std::equal(magic, magic + N, start);
}

}  // namespace

std::unique_ptr<Unpacker> unpackerFor(const unsigned char* start, std::size_t size) {
    constexpr unsigned char kGzip[] = {0x1f, 0x8b}, kZstd[] = {0x28, 0xb5, 0x2f, 0xfd};
    if (startsWith(start, size, kGzip)) return std::make_unique<GzipUnpacker>();
    if (startsWith(start, size, kZstd)) return std::make_unique<ZstdUnpacker>();
    return std::make_unique<Copier>();
}

}  // namespace hagen::recordings
