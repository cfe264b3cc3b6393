#include "support/CaptureWriter.h"

#include <algorithm>
#include <cmath>
#include <fstream>

namespace hagen::test {

using mrpt::obs::CObservationVelodyneScan;

ByteString bytesOf(const CObservationVelodyneScan::TVelodyneRawPacket& packet) {
    return {reinterpret_cast<const char*>(&packet), sizeof packet};
}

ByteString big16(unsigned value) {
    return {static_cast<char>(value >> 8 & 0xff), static_cast<char>(value & 0xff)};
}
ByteString big32(std::uint32_t value) { return big16(value >> 16) + big16(value & 0xffff); }
ByteString little32(std::uint32_t value) {
    ByteString bytes = big32(value);
    std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

namespace {

ByteString udpOf(const SentDatagram& datagram) {
    return big16(443) + big16(datagram.to_port) +
           big16(static_cast<unsigned>(datagram.content.size() + 8)) + big16(0) + datagram.content;
}

ByteString ipWith(const SentDatagram& datagram, const ByteString& content, unsigned flags) {
    return ByteString("\x45\x00", 2) + big16(static_cast<unsigned>(20 + content.size())) +
           big16(datagram.id) + big16(flags) + ByteString("\x80\x11\x00\x00", 4) +
           big32(datagram.from_ip) + big32(0xffffffff) + content;
}

}  // namespace

ByteString ipOf(const SentDatagram& datagram) { return ipWith(datagram, udpOf(datagram), 0x4000); }

std::vector<ByteString> fragmentsOf(const SentDatagram& datagram, std::size_t max) {
    const ByteString whole = udpOf(datagram);
    std::vector<ByteString> packets;
    for (std::size_t at = 0; at < whole.size(); at += max) {
        const unsigned more = at + max < whole.size() ? 0x2000 : 0;
        packets.push_back(
            ipWith(datagram, whole.substr(at, max), more | static_cast<unsigned>(at / 8)));
    }
    return packets;
}

ByteString ethernet(const ByteString& ip, int vlan_tags, unsigned type) {
    ByteString frame(12, '\x01');
    for (int i = 0; i < vlan_tags; ++i) frame += big16(i == 0 ? 0x88a8 : 0x8100) + big16(7);
    return frame + big16(type) + ip;
}

CaptureWriter::CaptureWriter(std::uint32_t link_type)
    : bytes_(little32(0xa1b2c3d4) + ByteString("\x02\x00\x04\x00", 4) + ByteString(8, '\0') +
             little32(65535) + little32(link_type)) {}

CaptureWriter& CaptureWriter::frame(const ByteString& frame, double time_s) {
    const double whole_s = std::floor(time_s);
    bytes_ += little32(static_cast<std::uint32_t>(whole_s)) +
              little32(static_cast<std::uint32_t>(std::lround(1e6 * (time_s - whole_s)))) +
              little32(static_cast<std::uint32_t>(frame.size())) +
              little32(static_cast<std::uint32_t>(frame.size())) + frame;
    return *this;
}

CaptureWriter& CaptureWriter::cutFrame(const ByteString& frame, std::size_t kept) {
    bytes_ += little32(1700000000) + little32(0) + little32(static_cast<std::uint32_t>(kept)) +
              little32(static_cast<std::uint32_t>(frame.size())) + frame.substr(0, kept);
    return *this;
}

CaptureWriter& CaptureWriter::datagram(const SentDatagram& datagram) {
    return frame(ethernet(ipOf(datagram)), datagram.time_s);
}

CaptureWriter& CaptureWriter::datagrams(const std::vector<ByteString>& contents, double period_s,
                                        std::uint16_t to_port) {
    SentDatagram sent;
    sent.to_port = to_port;
    for (const ByteString& content : contents) {
        sent.content = content;
        datagram(sent);
        sent.time_s += period_s;
    }
    return *this;
}

CaptureWriter& CaptureWriter::packets(const CObservationVelodyneScan& scan, double time_s,
                                      double period_s) {
    for (const auto& packet : scan.scan_packets) {
        datagram({bytesOf(packet), time_s});
        time_s += period_s;
    }
    return *this;
}

std::filesystem::path CaptureWriter::write(const std::filesystem::path& file) const {
    return writeBytes(file, bytes_);
}

ByteString pcapngOf(const std::vector<ByteString>& frames, double time_s) {
    const auto block = [](std::uint32_t type, const ByteString& body) {
        const auto size = static_cast<std::uint32_t>(body.size() + 12);
        return little32(type) + little32(size) + body + little32(size);
    };
    ByteString bytes = block(
        0x0a0d0d0a, little32(0x1a2b3c4d) + ByteString("\x01\0\0\0", 4) + ByteString(8, '\xff'));
    bytes += block(1, ByteString("\x01\0\0\0", 4) + little32(65535));  // an Ethernet interface
    const auto time_us = static_cast<std::uint64_t>(1e6 * time_s);
    for (const ByteString& frame : frames) {
        const auto size = static_cast<std::uint32_t>(frame.size());
        bytes += block(6, little32(0) + little32(static_cast<std::uint32_t>(time_us >> 32)) +
                              little32(static_cast<std::uint32_t>(time_us & 0xffffffff)) +
                              little32(size) + little32(size) + frame +
                              ByteString((4 - frame.size() % 4) % 4, '\0'));
    }
    return bytes;
}

std::filesystem::path writeBytes(const std::filesystem::path& file, const ByteString& bytes) {
    std::ofstream(file, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return file;
}

}  // namespace hagen::test
