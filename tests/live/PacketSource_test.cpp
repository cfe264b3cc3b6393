#include <gmock/gmock.h>
#include <hagen/live/PacketSource.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "support/CaptureWriter.h"
#include "support/LocalUdp.h"
#include "support/Program.h"

namespace hagen::live {
namespace {

using Next = PacketSource::Next;
using testing::HasSubstr;

/// A socket that sends to a local port.
class Sender {
 public:
    Sender() : socket_(socket(AF_INET, SOCK_DGRAM, 0)) {}
    ~Sender() { close(socket_); }
    void send(const std::string& bytes, const char* ip, std::uint16_t port) const {
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_port = htons(port);
        inet_pton(AF_INET, ip, &to.sin_addr);
        sendto(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to),
               sizeof to);
    }

 private:
    int socket_;
};

/// A port without a listener.
std::uint16_t freePort() {
    const int probe = socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    bind(probe, reinterpret_cast<const sockaddr*>(&at), sizeof at);
    socklen_t size = sizeof at;
    getsockname(probe, reinterpret_cast<sockaddr*>(&at), &size);
    close(probe);
    return ntohs(at.sin_port);
}

TEST(Address, ReadsOrRejectsText) {
    const Address address = parseAddress("192.168.1.77:2368");
    EXPECT_EQ(address.ip, 0xc0a8014du);
    EXPECT_EQ(address.port, 2368);
    EXPECT_FALSE(address.isMulticast());
    EXPECT_TRUE(parseAddress("239.1.2.3:1").isMulticast());
    EXPECT_FALSE(parseAddress("240.1.2.3:1").isMulticast());
    EXPECT_EQ(parseAddress("0.0.0.0:65535").ip, 0u);
    for (const char* wrong : {"", "2368", ":2368", "1.2.3:4", "localhost:5", "1.2.3.4", "1.2.3.4:",
                              "1.2.3.4:0", "1.2.3.4:65536", "1.2.3.4:-1", "1.2.3.4:9x"}) {
        EXPECT_NE(test::messageOf([&] { parseAddress(wrong); }), "") << wrong;
    }
}

/// One second of HDL-64E packets, or the system's maximum; Linux doubles the size for its own use.
TEST(UdpSource, RequestsLargeBuffer) {
    int max = 0;
    std::ifstream("/proc/sys/net/core/rmem_max") >> max;
    if (max == 0) GTEST_SKIP() << "the system does not report the maximum buffer size";
    const UdpSource source({0x7f000001, freePort()});
    EXPECT_GE(source.bufferBytes(), 2 * std::min(max, 8 << 20));
}

TEST(UdpSource, ReceivesDatagrams) {
    const std::uint16_t port = test::freePort();
    UdpSource source({0x7f000001, port});
    EXPECT_TRUE(source.isLive());
    Packet packet;
    EXPECT_EQ(source.next(packet), Next::Nothing);
    const double before_s = steadyNow_s();
    const test::LocalUdp sender;
    sender.send(std::string("abc"), test::localAddress(port));
    sender.send(std::string(""), test::localAddress(port));
    sender.send(std::string(9000, 'x'), test::localAddress(port));
    ASSERT_EQ(source.next(packet), Next::Packet);
    EXPECT_EQ(std::string(packet.bytes.begin(), packet.bytes.end()), "abc");
    EXPECT_EQ(sensors::ipText(packet.from_ip), "127.0.0.1");
    EXPECT_EQ(packet.to_port, port);
    EXPECT_EQ(sensors::ipText(packet.to_ip), "127.0.0.1");
    EXPECT_NE(packet.from_port, 0);
    EXPECT_GE(packet.arrival_s, before_s - 0.001);
    EXPECT_LE(packet.arrival_s, steadyNow_s());
    EXPECT_GT(packet.time_ns, 1700000000000000000);
    ASSERT_EQ(source.next(packet), Next::Packet);
    EXPECT_TRUE(packet.bytes.empty());
    ASSERT_EQ(source.next(packet), Next::Packet);
    EXPECT_EQ(packet.bytes.size(), 9000u);
}

/// After the process was stopped, packets in the buffer are old.
TEST(UdpSource, KeepsArrivalTimeOfDelayedPackets) {
    const std::uint16_t port = test::freePort();
    UdpSource source({0x7f000001, port});
    const test::LocalUdp sender;
    // The kernel starts to record arrival times shortly after the first socket requests them.
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    sender.send(std::string("abc"), test::localAddress(port));
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    sender.send(std::string("abc"), test::localAddress(port));
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    Packet first, second;
    ASSERT_EQ(source.next(first), Next::Packet);
    ASSERT_EQ(source.next(second), Next::Packet);
    EXPECT_GE(steadyNow_s() - first.arrival_s, 1.2);
    EXPECT_GE(second.arrival_s - first.arrival_s, 0.59);
}

TEST(UdpSource, ReportsUnusableAddress) {
    const std::uint16_t port = test::freePort();
    const UdpSource source({0x7f000001, port});
    EXPECT_THAT(test::messageOf([&] {
                    UdpSource({0x7f000001, port});
                }),
                HasSubstr("127.0.0.1:" + std::to_string(port) + ": cannot listen"));
    EXPECT_THAT(test::messageOf([&] { UdpSource({0x08080808, port}); }), HasSubstr("8.8.8.8"));
}

TEST(ReplaySource, ReplaysAtRecordedPace) {
    const test::TemporaryFolder folder;
    test::CaptureWriter writer;
    for (int i = 0; i < 5; ++i) {
        writer.datagram({std::string(10, static_cast<char>('a' + i)), 1700000000 + 0.1 * i});
    }
    const auto file = writer.write(folder / "a.pcap");
    for (const double speed : {1.0, 10.0}) {
        ReplaySource source(file, speed);
        EXPECT_FALSE(source.isLive());
        const double start_s = steadyNow_s();
        Packet packet;
        int count = 0;
        for (Next next = source.next(packet); next != Next::End; next = source.next(packet)) {
            if (next == Next::Nothing) continue;
            // Packets are never early, but may be late on a busy machine.
            EXPECT_GE(steadyNow_s() - start_s, 0.1 * count / speed - 0.001);
            EXPECT_EQ(packet.bytes[0], 'a' + count);
            EXPECT_NEAR(1e-9 * static_cast<double>(packet.time_ns), 1700000000 + 0.1 * count, 1e-4);
            ++count;
        }
        EXPECT_EQ(count, 5);
    }
}

/// A search through many frames without datagrams must be interruptible.
TEST(ReplaySource, LongSearchContinuesInNextCall) {
    const test::TemporaryFolder folder;
    const auto file = test::CaptureWriter().write(folder / "a.pcap");
    std::filesystem::resize_file(file, std::uint64_t{8} << 30);  // sparse: frames without content
    ReplaySource source(file, 1);
    Packet packet;
    for (int i = 0; i < 2; ++i) {
        const double start_s = steadyNow_s();
        EXPECT_EQ(source.next(packet), Next::Nothing);
        EXPECT_LT(steadyNow_s() - start_s, 2);
    }
}

/// Clock steps and hours without a sensor are not replayed as pauses.
TEST(ReplaySource, SkipsLongPauses) {
    const test::TemporaryFolder folder;
    test::CaptureWriter writer;
    for (const double time_s : {1.7e9, 1.7e9 + 1e6, 1.7e9 + 1e6 + 0.2, 1.0, 4e9, 4e9 + 0.2}) {
        writer.datagram({"a", time_s});
    }
    ReplaySource source(writer.write(folder / "a.pcap"), 1);
    const double start_s = steadyNow_s();
    Packet packet;
    while (source.next(packet) != Next::End) {
        ASSERT_LT(steadyNow_s() - start_s, 60);
    }
    EXPECT_GT(steadyNow_s() - start_s, 0.399);
}

}  // namespace
}  // namespace hagen::live
