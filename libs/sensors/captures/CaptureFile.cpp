#include <hagen/sensors/CaptureFile.h>
#include <pcap/pcap.h>
#include "base/ReadFile.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>

#include "sensors/captures/Fragments.h"
#include "sensors/captures/IpFrames.h"

namespace hagen::sensors {
namespace {

struct CloseCapture {
    void operator()(pcap_t* capture) const { pcap_close(capture); }
};

using PcapPtr = std::unique_ptr<pcap_t, CloseCapture>;

PcapPtr open(const std::filesystem::path& file) {
    base::checkIsFile(file);
    std::array<char, PCAP_ERRBUF_SIZE> why{};
    PcapPtr capture(pcap_open_offline_with_tstamp_precision(
        file.c_str(), PCAP_TSTAMP_PRECISION_NANO, why.data()));
    if (!capture) {
        throw BrokenCapture(file.string() + ": cannot be read as a capture: " + why.data());
    }
    return capture;
}

}  // namespace

std::string ipText(std::uint32_t ip) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8) {
        text += (text.empty() ? "" : ".") + std::to_string(ip >> shift & 0xff);
    }
    return text;
}

bool isCapture(const std::filesystem::path& file) {
    std::array<unsigned char, 4> start{};
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(reinterpret_cast<char*>(start.data()), start.size())) return false;
    using Start = std::array<unsigned char, 4>;
    // Magic numbers of pcap (microseconds or nanoseconds, either byte order), A. Kuznetzov's
    // modified pcap, and pcapng.
    for (const Start& known : {Start{0xd4, 0xc3, 0xb2, 0xa1}, Start{0xa1, 0xb2, 0xc3, 0xd4},
                               Start{0x4d, 0x3c, 0xb2, 0xa1}, Start{0xa1, 0xb2, 0x3c, 0x4d},
                               Start{0x34, 0xcd, 0xb2, 0xa1}, Start{0xa1, 0xb2, 0xcd, 0x34},
                               Start{0x0a, 0x0d, 0x0d, 0x0a}}) {
        if (start == known) return true;
    }
    return false;
}

struct CaptureFile::Reader {
    std::filesystem::path file;
    PcapPtr capture;
    double file_bytes;
    int link_type;
    FrameCounts counts;
    Fragments fragments;
    std::function<void()> check;

    explicit Reader(const std::filesystem::path& name)
        : file(name),
          capture(open(name)),
          file_bytes(static_cast<double>(std::filesystem::file_size(name))),
          link_type(pcap_datalink(capture.get())) {
        if (isKnownLink(link_type)) return;
        const char* const link = pcap_datalink_val_to_name(link_type);
        throw BrokenCapture(file.string() + ": was captured on a link of type " +
                            (link == nullptr ? std::to_string(link_type) : link) +
                            ", which is not supported; known: Ethernet, Linux 'any' and raw IP");
    }

    /// Counts the fragments of datagrams that are still incomplete at the end.
    void end() {
        fragments.giveUpAll();
        counts.fragments_lost = fragments.lost();
    }

    /// Reads the next frame; empty at the end of the file.
    bool nextFrame(Bytes& frame, const pcap_pkthdr*& header) {
        const long byte = std::ftell(pcap_file(capture.get()));
        pcap_pkthdr* read = nullptr;
        const u_char* data = nullptr;
        const int outcome = pcap_next_ex(capture.get(), &read, &data);
        if (outcome == 1) {
            header = read;
            frame = {data, read->caplen};
            return true;
        }
        end();
        if (outcome == PCAP_ERROR_BREAK) return false;
        throw BrokenCapture(file.string() + ": frame " + std::to_string(counts.frames) +
                            " at byte " + std::to_string(byte) +
                            " cannot be read: " + pcap_geterr(capture.get()));
    }

    /// Returns the datagram that this packet completes, with its UDP header; empty if the datagram
    /// is still incomplete.
    Bytes wholeOf(const IpPacket& packet) {
        if (!packet.isFragment()) return packet.content;
        ++counts.fragments;
        return fragments.add(packet);
    }

    /// Parses a complete datagram; returns false if it is truncated.
    static bool take(const IpPacket& packet, Bytes whole, const pcap_pkthdr& header,
                     Datagram& datagram) {
        if (whole.size < kUdpHeader) return false;
        const std::size_t size = whole.at16(4);
        if (size < kUdpHeader || size > whole.size) return false;
        // Malicious files may have arbitrary times. Unsigned arithmetic has defined overflow.
        datagram.time_ns =
            static_cast<std::int64_t>(static_cast<std::uint64_t>(header.ts.tv_sec) * 1000000000u +
                                      static_cast<std::uint64_t>(header.ts.tv_usec));
        datagram.from_ip = packet.from_ip;
        datagram.to_ip = packet.to_ip;
        datagram.from_port = static_cast<std::uint16_t>(whole.at16(0));
        datagram.to_port = static_cast<std::uint16_t>(whole.at16(2));
        datagram.bytes = whole.data + kUdpHeader;
        datagram.size = size - kUdpHeader;
        return true;
    }
};

CaptureFile::CaptureFile(const std::filesystem::path& file)
    : reader_(std::make_unique<Reader>(file)) {}

CaptureFile::~CaptureFile() = default;

bool CaptureFile::next(Datagram& datagram) {
    Reader& r = *reader_;
    Bytes frame;
    const pcap_pkthdr* header = nullptr;
    while (true) {
        const std::size_t frames = r.counts.frames;
        if (r.check && frames > 0 && frames % kFramesPerCheck == 0) r.check();
        if (!r.nextFrame(frame, header)) return false;
        ++r.counts.frames;
        const IpPacket packet = readFrame(r.link_type, frame);
        r.counts.tagged += packet.is_tagged;
        if (packet.kind == IpPacket::Kind::Other) {
            ++r.counts.other_traffic;
        } else if (packet.kind == IpPacket::Kind::Cut || header->caplen < header->len) {
            ++r.counts.cut_frames;
        } else if (const Bytes whole = r.wholeOf(packet); whole.data != nullptr) {
            if (Reader::take(packet, whole, *header, datagram)) {
                ++r.counts.datagrams;
                return true;
            }
            ++r.counts.cut_frames;
        }
    }
}

void CaptureFile::checkWhileReading(const std::function<void()>& check) { reader_->check = check; }

const FrameCounts& CaptureFile::counts() const { return reader_->counts; }

double CaptureFile::fractionRead() const {
    const long byte = std::ftell(pcap_file(reader_->capture.get()));
    return reader_->file_bytes > 0 ? static_cast<double>(byte) / reader_->file_bytes : 1.0;
}

}  // namespace hagen::sensors
