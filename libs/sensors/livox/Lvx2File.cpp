#include "sensors/livox/Lvx2File.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include "sensors/LittleEndian.h"

namespace hagen::sensors {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kPublicHeader = 24, kPrivateHeader = 5, kDevice = 63, kFrameHeader = 24;
constexpr std::size_t kPackage = 27, kUdpPacket = 36;  // headers
constexpr std::uint16_t kPort = 56300;                 // of points in Livox SDK 2

}  // namespace

Lvx2File::Lvx2File(const std::filesystem::path& file) : in_(file, std::ios::binary) {
    in_.seekg(0, std::ios::end);
    file_end_ = in_.tellg();
    in_.seekg(kPublicHeader);
    std::array<std::uint8_t, kPrivateHeader> header{};
    read(header.data(), header.size());
    frame_end_ = in_.tellg() + static_cast<std::streamoff>(kDevice * header[4]);
    in_.seekg(frame_end_);
}

bool Lvx2File::isLvx2(const std::filesystem::path& file) {
    std::array<char, kPublicHeader> start{};
    std::ifstream in(file, std::ios::binary);
    in.read(start.data(), start.size());
    const std::string_view bytes(start.data(), start.size());
    return in && bytes.substr(0, 10) == "livox_tech"sv && bytes[16] == 2 &&
           bytes.substr(20) == "\x67\xa7\x0e\xac"sv;
}

/// Returns false at the end of the file, if it may end here.
bool Lvx2File::read(std::uint8_t* to, std::size_t size, bool may_end) {
    in_.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(size));
    if (in_) return true;
    if (may_end && in_.gcount() == 0) return false;
    throw std::runtime_error("the file ends after " + std::to_string(in_.gcount()) + " of " +
                             std::to_string(size) + " bytes; is it truncated?");
}

bool Lvx2File::startFrame() {
    std::array<std::uint8_t, kFrameHeader> header{};
    in_.seekg(frame_end_);
    if (!read(header.data(), header.size(), true)) return false;
    const auto next = static_cast<std::int64_t>(little<std::uint64_t>(header.data() + 8));
    const std::int64_t start = position_ + static_cast<std::int64_t>(kFrameHeader);
    if (next != 0 && (next < start || next > file_end_)) {
        throw std::runtime_error("its frame claims to end at byte " + std::to_string(next) +
                                 "; is the file truncated?");
    }
    frame_end_ = next == 0 ? file_end_ : next;
    position_ = start;
    return true;
}

bool Lvx2File::next(Datagram& datagram) {
    position_ = in_.tellg();
    while (position_ >= frame_end_) {
        position_ = frame_end_;
        if (!startFrame()) return false;
    }
    // Version, lidar id and type, time type, time, number, data type, size, frame number, reserved.
    std::array<std::uint8_t, kPackage> header{};
    read(header.data(), header.size());
    const auto size = little<std::uint32_t>(header.data() + 18);
    const std::uint8_t type = header[17];
    const std::size_t point_bytes = type == 1 ? 14 : type == 2 ? 8 : 0;
    const std::size_t count = point_bytes > 0 ? size / point_bytes : 0;
    if (size > UINT16_MAX - kUdpPacket) {
        throw std::runtime_error("claims " + std::to_string(size) + " bytes");
    }
    packet_.assign(kUdpPacket + size, 0);
    const auto put16 = [&](std::size_t at, std::size_t number) {
        packet_[at] = static_cast<std::uint8_t>(number);
        packet_[at + 1] = static_cast<std::uint8_t>(number >> 8);
    };
    constexpr std::size_t kPointInterval = 50;  // of a Mid-360, in 0.1 us; the file has none
    put16(1, packet_.size());
    put16(3, std::min<std::size_t>(kPointInterval * count, UINT16_MAX));
    put16(5, count);
    std::copy_n(&header[15], 2, &packet_[7]);
    packet_[10] = type;
    std::copy_n(&header[7], 8, &packet_[28]);
    if (size > 0) read(&packet_[kUdpPacket], size);

    datagram = Datagram();
    datagram.time_ns = static_cast<std::int64_t>(little<std::uint64_t>(&header[7]));
    // The id has the bytes of the sensor's address in network order.
    datagram.from_ip = __builtin_bswap32(little<std::uint32_t>(&header[1]));
    datagram.from_port = kPort;
    datagram.to_port = kPort + 1;
    datagram.bytes = packet_.data();
    datagram.size = packet_.size();
    return true;
}

}  // namespace hagen::sensors
