#include "sensors/captures/FrameFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace hagen::sensors {
namespace {

constexpr std::size_t kMaxFrameBytes = 1 << 18, kMaxInterfaces = 1000;
constexpr std::uint32_t kSection = 0x0a0d0d0a, kByteOrder = 0x1a2b3c4d;
constexpr std::uint32_t kInterface = 1, kOldPacket = 2, kSimplePacket = 3, kPacket = 6;

struct PcapKind {
    std::uint32_t magic;
    std::uint64_t units_per_s;
    std::size_t record_header;  ///< bytes
};
constexpr PcapKind kPcapKinds[] = {
    {0xa1b2c3d4, 1000000, 16}, {0xa1b23c4d, 1000000000, 16}, {0xa1b2cd34, 1000000, 24}};

const PcapKind* kindOf(std::uint32_t magic) {
    for (const PcapKind& kind : kPcapKinds) {
        if (kind.magic == magic) return &kind;
    }
    return nullptr;
}

[[noreturn]] void fail(const std::string& why) { throw std::runtime_error(why); }

}  // namespace

FrameFile::FrameFile(const std::filesystem::path& file) : file_(gzopen(file.c_str(), "rb")) {
    if (!file_) fail("cannot be opened");
    gzbuffer(file_.get(), 1 << 17);
    readBody(4);
    if (number(0) == kSection) {
        is_pcapng_ = true;
        startSection();
        return;
    }
    is_big_endian_ = kindOf(number(0)) == nullptr;
    const PcapKind* const kind = kindOf(number(0));
    if (kind == nullptr) fail("is not a pcap or pcapng file");
    readBody(20);
    interfaces_.push_back({static_cast<int>(number(16, 2)), 0, kind->units_per_s, 0});
    if (is_big_endian_) interfaces_[0].link_type = static_cast<int>(number(18, 2));
    record_header_ = kind->record_header;
}

bool FrameFile::isCapture(const std::filesystem::path& file) {
    const std::unique_ptr<std::remove_pointer_t<gzFile>, Close> in(gzopen(file.c_str(), "rb"));
    std::array<std::uint8_t, 4> start{};
    if (!in || gzread(in.get(), start.data(), start.size()) != start.size()) return false;
    const std::uint32_t magic = Bytes{start.data(), start.size()}.at32(0);
    return magic == kSection || kindOf(magic) != nullptr ||
           kindOf(__builtin_bswap32(magic)) != nullptr;
}

/// The number in the last body, in the file's byte order.
std::uint32_t FrameFile::number(std::size_t at, std::size_t bytes) const {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < bytes; ++i) {
        number = number << 8 | body_[is_big_endian_ ? at + i : at + bytes - 1 - i];
    }
    return number;
}

/// Reads up to `size` bytes, fewer at the end of the file.
std::size_t FrameFile::read(std::uint8_t* to, std::size_t size) {
    const int count = gzread(file_.get(), to, static_cast<unsigned>(size));
    int error = Z_OK;
    const char* const why = gzerror(file_.get(), &error);
    if (count < 0 || error == Z_DATA_ERROR) fail(why);
    return static_cast<std::size_t>(count);
}

/// Reads bytes into `body_`. Returns false at the end of the file, if it may end here.
bool FrameFile::readBody(std::size_t size, bool may_end) {
    body_.resize(size);
    const std::size_t count = read(body_.data(), size);
    if (count == size) return true;
    int error = Z_OK;
    gzerror(file_.get(), &error);
    if (may_end && count == 0 && error != Z_BUF_ERROR) return false;
    fail("the file ends after " + std::to_string(count) + " of " + std::to_string(size) +
         " bytes; is it truncated, or still being written?");
}

void FrameFile::skip(std::uint64_t size) {
    constexpr std::uint64_t kPart = 1 << 16;
    for (; size > 0; size -= std::min(size, kPart)) readBody(std::min(size, kPart));
}

bool FrameFile::next(Frame& frame) {
    position_ = gztell(file_.get());
    return is_pcapng_ ? nextOfPcapng(frame) : nextOfPcap(frame);
}

std::int64_t FrameFile::bytesRead() const {
    return gzdirect(file_.get()) != 0 ? gztell(file_.get()) : gzoffset(file_.get());
}

std::optional<int> FrameFile::unknownLink() const {
    const bool has_known =
        std::any_of(interfaces_.begin(), interfaces_.end(),
                    [](const Interface& one) { return isKnownLink(one.link_type); });
    return has_known || interfaces_.empty() ? std::nullopt
                                            : std::optional(interfaces_[0].link_type);
}

bool FrameFile::nextOfPcap(Frame& frame) {
    if (!readBody(record_header_, true)) return false;
    const Interface& interface = interfaces_[0];
    const std::size_t size = number(8);
    frame.link_type = interface.link_type;
    frame.time_ns = timeOf(interface, number(0) * interface.units_per_s + number(4));
    frame.is_cut = size < number(12);
    if (size > kMaxFrameBytes) fail("claims " + std::to_string(size) + " bytes");
    readBody(size);
    frame.bytes = {body_.data(), size};
    return true;
}

bool FrameFile::nextOfPcapng(Frame& frame) {
    for (;; position_ = gztell(file_.get())) {
        if (!readBody(4, true)) return false;
        const std::uint32_t type = number(0);
        if (type == kSection) {
            startSection();
            continue;
        }
        readBody(4);
        constexpr std::size_t kAround = 12;  // type, and the size before and after the body
        const std::uint32_t size = number(0);
        if (size < kAround || size % 4 != 0) {
            fail("claims a block of " + std::to_string(size) + " bytes");
        }
        const bool is_frame = type == kPacket || type == kOldPacket || type == kSimplePacket;
        if (!is_frame && type != kInterface) {
            skip(size - 8);
            continue;
        }
        if (size > 2 * kMaxFrameBytes) fail("claims " + std::to_string(size) + " bytes");
        readBody(size - 8);
        if (number(size - kAround) != size) fail("the sizes around a block differ");
        body_.resize(size - kAround);
        if (type == kInterface) {
            addInterface();
            continue;
        }
        takeFrame(type, frame);
        return true;
    }
}

/// Reads a section header after its type.
void FrameFile::startSection() {
    readBody(8);
    is_big_endian_ = false;
    if (number(4) != kByteOrder) is_big_endian_ = true;
    if (number(4) != kByteOrder) fail("has an invalid section header");
    const std::uint32_t size = number(0);
    if (size < 28) fail("has a section header of " + std::to_string(size) + " bytes");
    skip(size - 12);
    interfaces_.clear();
}

/// Adds the interface in the last body.
void FrameFile::addInterface() {
    constexpr std::size_t kOptions = 8;
    constexpr std::uint32_t kResolution = 9, kOffset = 14;
    if (body_.size() < kOptions) fail("has an invalid interface description");
    if (interfaces_.size() == kMaxInterfaces) fail("has too many interfaces");
    Interface& interface = interfaces_.emplace_back();
    interface.link_type = static_cast<int>(number(0, 2));
    interface.snap_length = number(4);
    for (std::size_t at = kOptions; at + 4 <= body_.size();) {
        const std::uint32_t option = number(at, 2), size = number(at + 2, 2);
        at += 4;
        if (option == 0 || size > body_.size() - at) break;
        if (option == kResolution && size == 1) {
            const unsigned exponent = body_[at] & 0x7f;
            const bool is_binary = body_[at] >= 0x80;
            if (exponent > (is_binary ? 63 : 19)) fail("has an unsupported time resolution");
            interface.units_per_s = 1;
            for (unsigned i = 0; i < exponent; ++i) interface.units_per_s *= is_binary ? 2 : 10;
        } else if (option == kOffset && size == 8) {
            const std::uint64_t first = number(at), second = number(at + 4);
            interface.offset_s = static_cast<std::int64_t>(is_big_endian_ ? first << 32 | second
                                                                          : second << 32 | first);
        }
        at += (size + 3) / 4 * 4;
    }
}

/// Takes the frame in the last body, a packet block of this type.
void FrameFile::takeFrame(std::uint32_t type, Frame& frame) const {
    const bool is_simple = type == kSimplePacket;
    const std::size_t start = is_simple ? 4 : 20;
    if (body_.size() < start) fail("has an invalid packet block");
    const std::size_t index = is_simple ? 0 : number(0, type == kOldPacket ? 2 : 4);
    if (index >= interfaces_.size()) {
        fail("belongs to interface " + std::to_string(index) + ", which is not described");
    }
    const Interface& interface = interfaces_[index];
    const std::size_t original = number(is_simple ? 0 : 16);
    std::size_t size = is_simple ? original : number(12);
    if (is_simple && interface.snap_length > 0) {
        size = std::min<std::size_t>(size, interface.snap_length);
    }
    if (size > body_.size() - start) fail("claims " + std::to_string(size) + " bytes");
    frame.link_type = interface.link_type;
    frame.time_ns = is_simple ? 0 : timeOf(interface, std::uint64_t{number(4)} << 32 | number(8));
    frame.is_cut = size < original;
    frame.bytes = {body_.data() + start, size};
}

/// Corrupt files may have arbitrary times. Unsigned arithmetic has defined overflow.
std::int64_t FrameFile::timeOf(const Interface& interface, std::uint64_t units) {
    const auto second = static_cast<double>(interface.units_per_s);
    const auto part_ns = static_cast<std::uint64_t>(
        std::llround(1e9 * static_cast<double>(units % interface.units_per_s) / second));
    const std::uint64_t whole_s =
        units / interface.units_per_s + static_cast<std::uint64_t>(interface.offset_s);
    return static_cast<std::int64_t>(whole_s * 1000000000 + part_ns);
}

}  // namespace hagen::sensors
