#include "recordings/rawlogs/PackedInput.h"
#include <unistd.h>
#include <algorithm>
#include <cstring>

namespace hagen::recordings {
namespace {

constexpr std::size_t kPackedBytes = 1 << 17;
// ISA-L reads up to 8 bytes ahead, and may return them after the next bytes were read.
constexpr std::size_t kReturned = 8;
constexpr unsigned char kGzip[] = {0x1f, 0x8b}, kZstd[] = {0x28, 0xb5, 0x2f, 0xfd};

}  // namespace

PackedInput::PackedInput(const std::filesystem::path& file)
    : file_(std::fopen(file.c_str(), "rb")), packed_(kPackedBytes) {
    if (!file_) throw std::runtime_error(file.string() + ": cannot be opened");
    size_ = std::filesystem::file_size(file);
    const std::size_t start = std::fread(packed_.data(), 1, sizeof kZstd, file_.get());
    std::rewind(file_.get());
    const auto starts = [&](const auto& magic) {
        return start >= sizeof magic &&
               std::equal(std::begin(magic), std::end(magic), packed_.begin());
    };
    is_gzip_ = starts(kGzip);
    isal_inflate_init(&gzip_);
    gzip_.crc_flag = ISAL_GZIP;
    gzip_.next_in = packed_.data() + 2 * kReturned;
    if (!starts(kZstd)) return;
    lseek(descriptor(), 0, SEEK_SET);
    try {
        zstd_.emplace(descriptor());
    } catch (const std::runtime_error& e) {
        fault_ = std::string(e.what()) + "; try to decompress it with zstd -d --long=31";
    }
}

std::size_t PackedInput::readGzip(unsigned char* to, std::size_t count) {
    gzip_.next_out = to;
    gzip_.avail_out = static_cast<std::uint32_t>(count);
    while (gzip_.avail_out > 0 && fault_.empty()) {
        // ISA-L forgets the checksum of a header that spans two reads.
        const bool may_split_header =
            !is_in_member_ && gzip_.avail_in < packed_.size() / 2 && std::feof(file_.get()) == 0;
        if (gzip_.avail_in == 0 || may_split_header) {
            std::memmove(packed_.data() + kReturned, gzip_.next_in - kReturned,
                         kReturned + gzip_.avail_in);
            gzip_.next_in = packed_.data() + 2 * kReturned;
            unsigned char* const end = gzip_.next_in + gzip_.avail_in;
            const auto room = static_cast<std::size_t>(packed_.data() + packed_.size() - end);
            gzip_.avail_in += static_cast<std::uint32_t>(std::fread(end, 1, room, file_.get()));
        }
        const bool is_end = gzip_.avail_in == 0;  // ISA-L may still hold output
        if (!is_in_member_ && is_end) break;
        if (!is_in_member_ && *gzip_.next_in == 0) {  // padding after a member, as in gzip(1)
            ++gzip_.next_in;
            --gzip_.avail_in;
            continue;
        }
        const std::uint32_t wanted = gzip_.avail_out;
        const int code = isal_inflate(&gzip_);
        is_in_member_ = gzip_.block_state != ISAL_BLOCK_FINISH;
        if (code < 0) {
            fault_ = "the compressed data is corrupt";
            gzip_.avail_in = 0;  // may be below 0 after an error
        } else if (!is_in_member_) {
            isal_inflate_reset(&gzip_);
        } else if (is_end && gzip_.avail_out == wanted) {
            fault_ = "the file is truncated";
        }
    }
    return count - gzip_.avail_out;
}

std::size_t PackedInput::Read(void* buffer, std::size_t count) {
    std::size_t done = 0;
    try {
        if (!fault_.empty()) {
            return 0;
        } else if (zstd_) {
            done = zstd_->read(buffer, count);
            if (done < count && zstd_->consumed() < size_)
                fault_ = "the compressed data is corrupt";
        } else if (is_gzip_) {
            done = readGzip(static_cast<unsigned char*>(buffer), count);
        } else {
            done = std::fread(buffer, 1, count, file_.get());
        }
    } catch (const std::runtime_error& e) {
        fault_ = e.what();
    }
    if (std::ferror(file_.get()) != 0) fault_ = "the file has a read error";
    position_ += done;
    return done;
}

std::uint64_t PackedInput::packedPosition() const {
    return zstd_ ? zstd_->consumed()
                 : static_cast<std::uint64_t>(std::ftell(file_.get())) - gzip_.avail_in;
}

}  // namespace hagen::recordings
