#include <zlib.h>

#include <hagen/logs/GzipInput.h>
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace hagen::logs {
namespace {

constexpr std::size_t kPackedBytes = 1 << 17, kUnpackedBytes = 1 << 18;

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

/// The file and its buffers. zlib's gzread() silently ends at anything after a member that does not
/// look like another member, which would lose the rest of a damaged log.
struct GzipInput::Stream {
    std::unique_ptr<std::FILE, CloseFile> file;
    std::vector<unsigned char> packed = std::vector<unsigned char>(kPackedBytes);
    std::vector<unsigned char> unpacked = std::vector<unsigned char>(kUnpackedBytes);
    std::size_t unpacked_at = 0, unpacked_end = 0;
    std::uint64_t taken = 0;  ///< bytes of the file
    bool is_gzipped = false, is_in_member = false;
    std::string fault;
    z_stream inflater{};

    explicit Stream(std::FILE* opened) : file(opened) {
        constexpr int kGzipOnly = 31;
        if (inflateInit2(&inflater, kGzipOnly) != Z_OK) throw std::bad_alloc();
        fill();
        is_gzipped = inflater.avail_in >= 2 && packed[0] == 0x1f && packed[1] == 0x8b;
    }
    ~Stream() { inflateEnd(&inflater); }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;

    /// Reads the next block of the file; false at its end.
    bool fill() {
        const std::size_t bytes = std::fread(packed.data(), 1, packed.size(), file.get());
        if (std::ferror(file.get()) != 0) fault = "the file cannot be read further";
        inflater.next_in = packed.data();
        inflater.avail_in = static_cast<unsigned>(bytes);
        taken += bytes;
        return bytes > 0;
    }

    /// Decompresses the next block; false at the end and on a fault.
    bool unpack() {
        inflater.next_out = unpacked.data();
        inflater.avail_out = static_cast<unsigned>(unpacked.size());
        while (inflater.avail_out > 0 && fault.empty()) {
            if (inflater.avail_in == 0 && !fill()) {
                if (is_in_member && fault.empty()) fault = "the file is truncated";
                break;
            }
            if (is_gzipped) {
                inflateMember();
            } else {
                copy();
            }
        }
        unpacked_at = 0;
        unpacked_end = unpacked.size() - inflater.avail_out;
        return unpacked_end > 0;
    }

 private:
    void inflateMember() {
        is_in_member = true;
        const int code = inflate(&inflater, Z_NO_FLUSH);
        if (code == Z_STREAM_END) {
            is_in_member = false;  // only another member may follow
            inflateReset(&inflater);
        } else if (code != Z_OK) {
            fault = "the compressed data is corrupt";
        }
    }
    void copy() {
        const unsigned bytes = std::min(inflater.avail_in, inflater.avail_out);
        std::memcpy(inflater.next_out, inflater.next_in, bytes);
        inflater.next_in += bytes;
        inflater.avail_in -= bytes;
        inflater.next_out += bytes;
        inflater.avail_out -= bytes;
    }
};

GzipInput::GzipInput(const std::filesystem::path& file) {
    std::FILE* const opened = std::fopen(file.c_str(), "rb");
    if (opened == nullptr) throw std::runtime_error(file.string() + ": cannot be opened");
    stream_ = std::make_unique<Stream>(opened);
}

GzipInput::~GzipInput() = default;

std::size_t GzipInput::Read(void* buffer, std::size_t count) {
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

std::uint64_t GzipInput::packedPosition() const {
    return stream_->taken - stream_->inflater.avail_in;
}

std::string GzipInput::fault() const {
    // Data decompressed before the fault is delivered first.
    return stream_->unpacked_at == stream_->unpacked_end ? stream_->fault : "";
}

std::size_t GzipInput::Write(const void*, std::size_t) {
    throw std::logic_error("an input cannot be written");
}
std::uint64_t GzipInput::Seek(std::int64_t, TSeekOrigin) {
    throw std::logic_error("a compressed input cannot seek");
}
std::uint64_t GzipInput::getTotalBytesCount() const {
    throw std::logic_error("the uncompressed size is unknown");
}

}  // namespace hagen::logs
