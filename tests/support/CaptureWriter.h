#pragma once
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::test {

using ByteString = std::string;

ByteString bytesOf(const mrpt::obs::CObservationVelodyneScan::TVelodyneRawPacket& packet);

/// A UDP datagram to write.
struct SentDatagram {
    ByteString content;
    double time_s = 1700000000;
    std::uint32_t from_ip = 0x0a000064;
    std::uint16_t to_port = 2368;
    std::uint16_t id = 0;  ///< IP identification
};

/// A number in network order, e.g. "\x12\x34".
ByteString big16(unsigned value);
ByteString big32(std::uint32_t value);
ByteString little32(std::uint32_t value);

/// The IP packet of a datagram, with a valid header but no checksums.
ByteString ipOf(const SentDatagram& datagram);
/// The IP packets of a datagram's fragments, with at most `max` bytes each.
std::vector<ByteString> fragmentsOf(const SentDatagram& datagram, std::size_t max);
/// An Ethernet frame; each tag adds a VLAN header.
ByteString ethernet(const ByteString& ip, int vlan_tags = 0, unsigned type = 0x0800);

/// Writes a .pcap file of frames.
class CaptureWriter {
 public:
    explicit CaptureWriter(std::uint32_t link_type = 1);

    CaptureWriter& frame(const ByteString& frame, double time_s = 1700000000);
    /// Writes a frame that was captured only up to `kept` bytes.
    CaptureWriter& cutFrame(const ByteString& frame, std::size_t kept);
    CaptureWriter& datagram(const SentDatagram& datagram);
    CaptureWriter& datagrams(const std::vector<ByteString>& contents, double period_s = 1e-3,
                             std::uint16_t to_port = 2368);
    CaptureWriter& packets(const mrpt::obs::CObservationVelodyneScan& scan, double time_s,
                           double period_s = 1e-3);

    const ByteString& bytes() const { return bytes_; }
    std::filesystem::path write(const std::filesystem::path& file) const;

 private:
    ByteString bytes_;
};

/// A .pcapng file with the same frames.
ByteString pcapngOf(const std::vector<ByteString>& frames, double time_s = 1700000000);

std::filesystem::path writeBytes(const std::filesystem::path& file, const ByteString& bytes);

}  // namespace hagen::test
