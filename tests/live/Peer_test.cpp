#include "live/mavlink/Peer.h"
#include <fcntl.h>
#include <gmock/gmock.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <future>
#include <thread>

#include "support/LocalUdp.h"
#include "support/Program.h"

namespace hagen::mavlink {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

TEST(ParsePeer, ReadsUdpAndSerialPeers) {
    const PeerAddress udp = parsePeer("udp:192.168.1.10:14550");
    EXPECT_EQ(udp.kind, PeerAddress::Kind::Udp);
    EXPECT_EQ(udp.host, "192.168.1.10");
    EXPECT_EQ(udp.port, 14550);
    EXPECT_EQ(udp.local_port, 0);
    EXPECT_EQ(parsePeer("udp:localhost:14580:14540").local_port, 14540);
    const PeerAddress serial = parsePeer("serial:/dev/serial/by-id/usb-3D:0:921600");
    EXPECT_EQ(serial.kind, PeerAddress::Kind::Serial);
    EXPECT_EQ(serial.device, "/dev/serial/by-id/usb-3D:0");
    EXPECT_EQ(serial.baud, 921600);
}

TEST(ParsePeer, ReportsErrors) {
    const auto messageOf = [](const std::string& text) {
        return test::messageOf([&] { parsePeer(text); });
    };
    for (const char* text : {"", "udp", "udp::14550", "tcp:1.2.3.4:5", "udp:1.2.3.4", "udp:a:1:2:3",
                             "serial:", "serial::115200", "/dev/ttyUSB0"}) {
        EXPECT_THAT(messageOf(text), HasSubstr("neither udp:HOST:PORT nor serial:DEVICE:BAUD"))
            << text;
    }
    for (const char* text : {"udp:1.2.3.4:0", "udp:1.2.3.4:70000", "udp:1.2.3.4:x",
                             "udp:1.2.3.4:99999999999999", "udp:1.2.3.4:5:-1"}) {
        EXPECT_THAT(messageOf(text), HasSubstr("1 to 65535")) << text;
    }
    EXPECT_THAT(messageOf("serial:/dev/ttyS0:123456"), HasSubstr("unsupported baud rate"));
    EXPECT_THAT(messageOf("serial:/dev/ttyS0:fast"), HasSubstr("unsupported baud rate"));
    EXPECT_THAT(messageOf("serial:/dev/ttyS0:57600"), HasSubstr("at least 115200 baud"));
}

TEST(PeerOpen, ReportsMissingPeer) {
    EXPECT_THAT(test::messageOf([] { Peer::open(parsePeer("serial:/dev/none:115200")); }),
                HasSubstr("/dev/none: cannot be used: No such file"));
    EXPECT_THAT(test::messageOf([] { Peer::open(parsePeer("serial:/dev/null:115200")); }),
                HasSubstr("/dev/null: cannot be used"));
    EXPECT_THAT(test::messageOf([] { Peer::open(parsePeer("udp:no host.invalid:14550")); }),
                HasSubstr("no such host"));
}

/// The other end of a UDP connection, which replies to the latest sender.
class UdpEnd {
 public:
    explicit UdpEnd(std::uint16_t port = 0) : socket_(std::chrono::seconds(2), port) {}

    Bytes receive() {
        const auto got = socket_.receive();
        if (!got) return {};
        from_ = got->from;
        return Bytes(got->bytes.begin(), got->bytes.end());
    }
    void answer(const Bytes& bytes) const { socket_.send(bytes, from_); }
    std::uint16_t port() const { return socket_.port(); }
    std::uint16_t fromPort() const { return ntohs(from_.sin_port); }
    bool isBound() const { return socket_.isBound(); }

 private:
    test::LocalUdp socket_;
    sockaddr_in from_{};
};

std::unique_ptr<Peer> peerAt(std::uint16_t port) {
    return Peer::open(parsePeer("udp:127.0.0.1:" + std::to_string(port)));
}

Bytes received(Peer& peer) {
    std::array<std::uint8_t, 2048> buffer{};
    const std::size_t size = peer.receive(buffer.data(), buffer.size(), 2);
    return Bytes(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size));
}

TEST(UdpPeer, SendsAndReceives) {
    UdpEnd other;
    const auto peer = peerAt(other.port());
    EXPECT_TRUE(peer->send({1, 2, 3}));
    EXPECT_EQ(other.receive(), (Bytes{1, 2, 3}));
    other.answer({4, 5});
    EXPECT_EQ(received(*peer), (Bytes{4, 5}));
    EXPECT_TRUE(peer->hasDatagrams());
    EXPECT_EQ(peer->trouble(), "");
}

/// 0.0.0.0 is this machine, which replies from 127.0.0.1.
TEST(UdpPeer, CountsOtherSenders) {
    UdpEnd other;
    const auto peer = Peer::open(parsePeer("udp:0.0.0.0:" + std::to_string(other.port())));
    EXPECT_TRUE(peer->send({1}));
    EXPECT_EQ(other.receive(), Bytes{1});
    const test::LocalUdp stranger;
    stranger.send(Bytes{9}, test::localAddress(other.fromPort()));
    other.answer({2});
    EXPECT_EQ(received(*peer), Bytes{2});
    EXPECT_EQ(peer->ignored().datagrams, 1u);
    EXPECT_EQ(peer->ignored().sender, "127.0.0.1:" + std::to_string(stranger.port()));
}

TEST(UdpPeer, SurvivesRefusedConnection) {
    auto other = std::make_unique<UdpEnd>();
    const std::uint16_t port = other->port();
    const auto peer = peerAt(port);
    other.reset();
    for (int i = 0; i < 20 && peer->trouble().empty(); ++i) {
        peer->send({1});
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_THAT(peer->trouble(), HasSubstr("127.0.0.1:" + std::to_string(port)));
    EXPECT_THAT(peer->trouble(), HasSubstr("connection refused"));
    std::array<std::uint8_t, 16> buffer{};
    peer->receive(buffer.data(), buffer.size(), 0);
    const double start_s = test::steadyNow_s();
    peer->receive(buffer.data(), buffer.size(), 0.1);
    EXPECT_GE(test::steadyNow_s() - start_s, 0.09);  // waits although there was an error
    UdpEnd again(port);
    ASSERT_TRUE(again.isBound());
    EXPECT_TRUE(peer->send({7}));
    EXPECT_EQ(again.receive(), Bytes{7});
    again.answer({8});
    EXPECT_EQ(received(*peer), Bytes{8});
    EXPECT_EQ(peer->trouble(), "");
}

/// A negative timeout must not mean an infinite wait.
void expectNoWait(Peer& peer) {
    for (const double longest_s : {0.0, -0.0005, -0.002, -1e300, std::nan("")}) {
        std::array<std::uint8_t, 16> buffer{};
        std::promise<std::size_t> received;
        auto size = received.get_future();
        std::thread waits(
            [&] { received.set_value(peer.receive(buffer.data(), buffer.size(), longest_s)); });
        const bool has_ended = size.wait_for(std::chrono::seconds(5)) == std::future_status::ready;
        if (!has_ended) {
            ADD_FAILURE() << "waits forever: " << longest_s;
            std::exit(1);  // the thread cannot be stopped
        }
        waits.join();
        EXPECT_EQ(size.get(), 0u);
    }
}

TEST(UdpPeer, ReturnsAtOncePastDeadline) {
    const UdpEnd other;
    expectNoWait(*peerAt(other.port()));
}

/// A serial line connected to this test.
class Line {
 public:
    explicit Line(const std::filesystem::path& name)
        : name_(name), end_(posix_openpt(O_RDWR | O_NOCTTY)) {
        grantpt(end_);
        unlockpt(end_);
        std::filesystem::remove(name);
        std::filesystem::create_symlink(ptsname(end_), name);
    }
    ~Line() { close(end_); }

    Bytes receive(std::size_t size) const {
        Bytes bytes(size);
        const ssize_t got = read(end_, bytes.data(), size);
        bytes.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
        return bytes;
    }
    void send(const Bytes& bytes) const {
        EXPECT_EQ(write(end_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
    }

 private:
    std::filesystem::path name_;
    int end_;
};

class SerialPeerTest : public testing::Test {
 protected:
    std::unique_ptr<Peer> open() const {
        return Peer::open(parsePeer("serial:" + name_ + ":115200"));
    }

    const test::TemporaryFolder folder_;
    const std::string name_ = (folder_ / "line").string();
    std::unique_ptr<Line> line_ = std::make_unique<Line>(name_);
};

TEST_F(SerialPeerTest, SurvivesUnpluggedLine) {
    const auto peer = open();
    EXPECT_FALSE(peer->hasDatagrams());
    // These bytes would be translated or interpreted by a terminal.
    const Bytes special{0x03, 0x04, '\n', '\r', 0x11, 0x13, 0x7f, 0xfd, 0xff, 0x00};
    EXPECT_TRUE(peer->send(special));
    EXPECT_EQ(line_->receive(64), special);
    line_->send(special);
    EXPECT_EQ(received(*peer), special);

    line_.reset();
    for (int i = 0; i < 20 && peer->trouble().empty(); ++i) received(*peer);
    EXPECT_THAT(peer->trouble(), HasSubstr(name_ + ": cannot be used"));
    EXPECT_FALSE(peer->send({1}));

    line_ = std::make_unique<Line>(name_);
    for (int i = 0; i < 100 && !peer->send({9}); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_EQ(line_->receive(64), Bytes{9});
    EXPECT_EQ(peer->trouble(), "");
}

TEST_F(SerialPeerTest, ReturnsAtOncePastDeadline) {
    const auto peer = open();
    expectNoWait(*peer);
    line_.reset();  // unplugged
    for (int i = 0; i < 20 && peer->trouble().empty(); ++i) received(*peer);
    expectNoWait(*peer);
}

/// If a service starts without standard input, the line gets descriptor 0.
TEST_F(SerialPeerTest, WorksAsFileDescriptorZero) {
    const int input = dup(0);
    if (input < 0) GTEST_SKIP() << "standard input is closed";
    close(0);
    {
        const auto peer = open();
        EXPECT_TRUE(isatty(0));
        const Bytes special{0x03, '\n', '\r', 0x7f, 0xff};
        EXPECT_TRUE(peer->send(special));
        EXPECT_EQ(line_->receive(64), special);
        line_->send(special);
        EXPECT_EQ(received(*peer), special);
    }
    dup2(input, 0);
    close(input);
}

TEST_F(SerialPeerTest, SendsWholeMessagesOnly) {
    const auto peer = open();
    // Fills the line without reading.
    const std::size_t size = 200;
    std::uint8_t sent = 0;
    while (sent < 250 && peer->send(Bytes(size, sent))) ++sent;
    ASSERT_LT(sent, 250);
    Bytes all;
    for (int i = 0; i < 400 && all.size() < (sent + 1u) * size; ++i) {
        const Bytes part = line_->receive(4096);
        all.insert(all.end(), part.begin(), part.end());
        // The rest of a partly sent message is sent first.
        if (peer->send(Bytes(size, sent))) break;
    }
    while (all.size() < (sent + 1u) * size) {
        const Bytes part = line_->receive(4096);
        all.insert(all.end(), part.begin(), part.end());
    }
    ASSERT_EQ(all.size(), (sent + 1u) * size);
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], i / size);
}

/// Stale obstacles are not sent when the line works again.
TEST_F(SerialPeerTest, ReportsBlockedLineAndDropsBacklog) {
    const auto peer = open();
    constexpr std::size_t kSize = 200;
    std::size_t sent = 0;
    while (sent < 250 && peer->send(Bytes(kSize, 1))) ++sent;
    ASSERT_LT(sent, 250u);
    EXPECT_EQ(peer->trouble(), "");
    for (int i = 0; i < 100 && peer->trouble().empty(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        peer->send(Bytes(kSize, 2));
    }
    ASSERT_THAT(peer->trouble(), HasSubstr(name_ + ": does not accept data"));
    EXPECT_TRUE(peer->send(Bytes(kSize, 4)));

    Bytes all;
    while (all.empty() || all.back() != 4) {
        const Bytes part = line_->receive(4096);
        ASSERT_FALSE(part.empty());
        all.insert(all.end(), part.begin(), part.end());
    }
    // The other end of a pseudoterminal keeps the bytes it has accepted.
    EXPECT_LT(all.size(), sent * kSize / 2);
    EXPECT_EQ(std::count(all.begin(), all.end(), 4), static_cast<std::ptrdiff_t>(kSize));
    for (int i = 0; i < 40 && !peer->trouble().empty(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        EXPECT_TRUE(peer->send(Bytes(kSize, 3)));
        line_->receive(4096);
    }
    EXPECT_EQ(peer->trouble(), "");
}

}  // namespace
}  // namespace hagen::mavlink
