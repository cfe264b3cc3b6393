#include "sensors/captures/CaptureWriter.h"
#include <gtest/gtest.h>

#include "support/Program.h"

namespace hagen::sensors {
namespace {

Datagram datagramOf(const std::string& bytes) {
    Datagram datagram;
    datagram.time_ns = 1700000000123456789;
    datagram.from_ip = 0x0a000064;
    datagram.to_ip = 0xc0a80101;
    datagram.from_port = 40000;
    datagram.to_port = 2368;
    datagram.bytes = reinterpret_cast<const std::uint8_t*>(bytes.data());
    datagram.size = bytes.size();
    return datagram;
}

TEST(CaptureWriter, WritesFilesReadableByCaptureFile) {
    const test::TemporaryFolder folder;
    const std::vector<std::string> contents{"", "a", std::string(1206, 'v'),
                                            std::string(65507, 'x')};
    sensors::CaptureWriter writer(folder / "a.pcap");
    for (const std::string& content : contents) writer.add(datagramOf(content));
    writer.flush();
    EXPECT_TRUE(isCapture(folder / "a.pcap"));
    CaptureFile capture(folder / "a.pcap");
    Datagram read;
    for (const std::string& content : contents) {
        ASSERT_TRUE(capture.next(read));
        EXPECT_EQ(std::string(reinterpret_cast<const char*>(read.bytes), read.size), content);
        EXPECT_EQ(read.time_ns, 1700000000123456789);
        EXPECT_EQ(ipText(read.from_ip), "10.0.0.100");
        EXPECT_EQ(ipText(read.to_ip), "192.168.1.1");
        EXPECT_EQ(read.from_port, 40000);
        EXPECT_EQ(read.to_port, 2368);
    }
    EXPECT_FALSE(capture.next(read));
}

TEST(CaptureWriter, WritesIpv6) {
    const test::TemporaryFolder folder;
    sensors::CaptureWriter writer(folder / "a.pcap");
    Datagram sent = datagramOf("hello");
    sent.from_ip = {0xfe80000000000000, 0x0123456789abcdef};
    sent.to_ip = {0xff02000000000000, 1};
    writer.add(sent);
    writer.add(sent);
    writer.flush();
    CaptureFile capture(folder / "a.pcap");
    Datagram read;
    for (int i = 0; i < 2; ++i) {
        ASSERT_TRUE(capture.next(read));
        EXPECT_EQ(read.size, 5u);
        EXPECT_EQ(ipText(read.from_ip), "fe80::123:4567:89ab:cdef");
        EXPECT_EQ(read.to_ip, sent.to_ip);
    }
    EXPECT_FALSE(capture.next(read));
}

/// As a receiver checks, the header's words, including the checksum, sum to ffff.
TEST(CaptureWriter, WritesValidIpChecksums) {
    const test::TemporaryFolder folder;
    sensors::CaptureWriter writer(folder / "a.pcap");
    writer.add(datagramOf("hello"));
    writer.flush();
    const std::string bytes = test::readFile(folder / "a.pcap");
    unsigned sum = 0;
    for (std::size_t i = 24 + 16 + 14; i < 24 + 16 + 14 + 20; i += 2) {
        sum +=
            static_cast<unsigned char>(bytes[i]) * 256u + static_cast<unsigned char>(bytes[i + 1]);
    }
    EXPECT_EQ((sum & 0xffff) + (sum >> 16), 0xffffu);
}

/// If the program is killed, the file ends with a complete block.
TEST(CaptureWriter, EndsWithWholeFrame) {
    const test::TemporaryFolder folder;
    sensors::CaptureWriter writer(folder / "a.pcap");
    int blocks = 0;
    for (int i = 0; i < 200; ++i) {
        blocks += writer.add(datagramOf(std::string(1206, 'v')));
        CaptureFile capture(folder / "a.pcap");
        Datagram read;
        while (capture.next(read)) {
        }
        EXPECT_EQ(capture.counts().cut_frames, 0u);
    }
    EXPECT_EQ(blocks, 3);
}

}  // namespace
}  // namespace hagen::sensors
