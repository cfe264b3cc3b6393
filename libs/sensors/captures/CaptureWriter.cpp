#include "sensors/captures/CaptureWriter.h"
#include "base/WriteFile.h"
#include "sensors/captures/IpFrames.h"

#include <system_error>

namespace hagen::sensors {
namespace {

constexpr std::size_t kBlockBytes = 1 << 16;
constexpr std::size_t kEthernetHeader = 14, kIpHeader = 20, kIpv6Header = 40;

// pcap in little-endian byte order; network headers in network order.
void append16(std::string& bytes, unsigned value) {
    bytes += static_cast<char>(value >> 8 & 0xff);
    bytes += static_cast<char>(value & 0xff);
}
void append32(std::string& bytes, std::uint32_t value) {
    append16(bytes, value >> 16);
    append16(bytes, value & 0xffff);
}
void appendLittle32(std::string& bytes, std::uint64_t value) {
    for (int shift = 0; shift < 32; shift += 8) {
        bytes += static_cast<char>(value >> shift & 0xff);
    }
}

void appendIp(std::string& bytes, const IpAddress& ip, bool is_ipv4) {
    const auto low = static_cast<std::uint32_t>(ip.low);
    if (is_ipv4) return append32(bytes, low);
    append32(bytes, static_cast<std::uint32_t>(ip.high >> 32));
    append32(bytes, static_cast<std::uint32_t>(ip.high));
    append32(bytes, static_cast<std::uint32_t>(ip.low >> 32));
    append32(bytes, low);
}

/// Appends a locally administered MAC address; hosts are distinguished by IP address.
void appendMac(std::string& bytes, const IpAddress& ip) {
    append16(bytes, 0x0200);
    append32(bytes, static_cast<std::uint32_t>(ip.low));
}

/// The IPv4 header checksum: the complemented sum of the 16-bit words.
unsigned checksumOf(const std::string& bytes, std::size_t from, std::size_t size) {
    unsigned sum = 0;
    for (std::size_t i = from; i < from + size; i += 2) {
        sum +=
            static_cast<unsigned char>(bytes[i]) * 256u + static_cast<unsigned char>(bytes[i + 1]);
    }
    sum = (sum >> 16) + (sum & 0xffff);
    return ~(sum + (sum >> 16)) & 0xffff;
}

bool isIpv4(const Datagram& datagram) {
    return datagram.from_ip.isIpv4() && datagram.to_ip.isIpv4();
}

void appendFrame(std::string& bytes, const Datagram& datagram) {
    const auto udp_bytes = static_cast<unsigned>(kUdpHeader + datagram.size);
    appendMac(bytes, datagram.to_ip);
    appendMac(bytes, datagram.from_ip);
    if (isIpv4(datagram)) {
        append16(bytes, 0x0800);
        const std::size_t ip = bytes.size();
        append16(bytes, 0x4500);
        append16(bytes, kIpHeader + udp_bytes);
        append32(bytes, 0x00004000);  // not fragmented
        append16(bytes, 0x4011);      // time to live 64, UDP
        append16(bytes, 0);           // checksum
        appendIp(bytes, datagram.from_ip, true);
        appendIp(bytes, datagram.to_ip, true);
        const unsigned checksum = checksumOf(bytes, ip, kIpHeader);
        bytes[ip + 10] = static_cast<char>(checksum >> 8);
        bytes[ip + 11] = static_cast<char>(checksum & 0xff);
    } else {
        append16(bytes, 0x86dd);
        append32(bytes, 0x60000000);
        append16(bytes, udp_bytes);
        append16(bytes, 0x1140);  // UDP, hop limit 64
        appendIp(bytes, datagram.from_ip, false);
        appendIp(bytes, datagram.to_ip, false);
    }
    append16(bytes, datagram.from_port);
    append16(bytes, datagram.to_port);
    append16(bytes, udp_bytes);
    append16(bytes, 0);  // no checksum
    bytes.append(reinterpret_cast<const char*>(datagram.bytes), datagram.size);
}

}  // namespace

CaptureWriter::CaptureWriter(const std::filesystem::path& file)
    : file_(file), out_(base::openToWrite(file, file)) {
    appendLittle32(block_, 0xa1b23c4d);  // pcap with nanoseconds
    appendLittle32(block_, 0x00040002);  // version 2.4
    appendLittle32(block_, 0);
    appendLittle32(block_, 0);
    appendLittle32(block_, 1 << 18);  // snap length
    appendLittle32(block_, 1);        // Ethernet
    flush();
}

bool CaptureWriter::add(const Datagram& datagram) {
    const auto time_ns = static_cast<std::uint64_t>(datagram.time_ns);
    const std::uint64_t frame_bytes =
        kEthernetHeader + (isIpv4(datagram) ? kIpHeader : kIpv6Header) + kUdpHeader + datagram.size;
    appendLittle32(block_, time_ns / 1000000000);
    appendLittle32(block_, time_ns % 1000000000);
    appendLittle32(block_, frame_bytes);  // captured length
    appendLittle32(block_, frame_bytes);  // original length
    appendFrame(block_, datagram);
    if (block_.size() < kBlockBytes) return false;
    flush();
    return true;
}

void CaptureWriter::flush() {
    errno = 0;
    out_.write(block_.data(), static_cast<std::streamsize>(block_.size())).flush();
    if (!out_) {
        const int error = errno;
        std::error_code ignored;
        std::filesystem::resize_file(file_, written_bytes_, ignored);
        base::throwWriteError(file_, error);
    }
    written_bytes_ += block_.size();
    block_.clear();
}

}  // namespace hagen::sensors
