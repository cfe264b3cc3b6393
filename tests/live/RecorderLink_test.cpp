#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/live/RecorderLink.h>
#include <sys/socket.h>
#include <unistd.h>

#include <thread>

#include "support/Program.h"

namespace hagen::live {
namespace {

using testing::HasSubstr;

class RecorderLinkTest : public testing::Test {
 protected:
    RecorderLinkTest() { socketpair(AF_UNIX, SOCK_STREAM, 0, ends_); }
    ~RecorderLinkTest() override {
        for (const int end : ends_) close(end);
    }
    static Packet packetOf(std::size_t bytes, std::uint8_t first, std::int64_t time_ns) {
        Packet packet;
        for (std::size_t i = 0; i < bytes; ++i) {
            packet.bytes.push_back(static_cast<std::uint8_t>(first + i));
        }
        packet.time_ns = time_ns;
        return packet;
    }
    int ends_[2] = {-1, -1};
};

TEST_F(RecorderLinkTest, PacketsComeAsTheyWereSent) {
    // More than the socket holds, of all sizes that a datagram may have.
    std::vector<Packet> sent;
    for (int k = 0; k < 200; ++k) {
        sent.push_back(packetOf(k % 3 == 0 ? 1206 : 24832, static_cast<std::uint8_t>(k), 1000 + k));
    }
    sent.push_back(packetOf(0, 0, -5));
    sent.push_back(packetOf(65507, 7, 9));
    std::thread sender([&] {
        for (const Packet& packet : sent) EXPECT_TRUE(sendPacket(ends_[0], packet));
        shutdown(ends_[0], SHUT_WR);
    });
    PacketReader reader(ends_[1]);
    Packet packet;
    for (const Packet& expected : sent) {
        ASSERT_TRUE(reader.next(packet));
        ASSERT_EQ(packet.bytes, expected.bytes);
        ASSERT_EQ(packet.time_ns, expected.time_ns);
    }
    EXPECT_FALSE(reader.next(packet));
    sender.join();
}

TEST_F(RecorderLinkTest, APacketThatBreaksOffIsNone) {
    const std::uint64_t header[2] = {1206, 17};
    ASSERT_EQ(write(ends_[0], header, sizeof header), 16);
    ASSERT_EQ(write(ends_[0], "abc", 3), 3);
    shutdown(ends_[0], SHUT_WR);
    Packet packet;
    EXPECT_FALSE(PacketReader(ends_[1]).next(packet));
}

TEST_F(RecorderLinkTest, NoDatagramIsLongerThanUdpAllows) {
    const std::uint64_t header[2] = {std::uint64_t{1} << 40, 17};
    ASSERT_EQ(write(ends_[0], header, sizeof header), 16);
    Packet packet;
    EXPECT_FALSE(PacketReader(ends_[1]).next(packet));
}

TEST_F(RecorderLinkTest, ARecorderThatEndedTakesNothing) {
    shutdown(ends_[1], SHUT_RDWR);
    EXPECT_FALSE(sendPacket(ends_[0], packetOf(1206, 0, 0)));  // and no signal ends this test
}

TEST_F(RecorderLinkTest, LinesSayWhatBecameOfTheRecording) {
    Recorded recorded;
    recorded.turns = 12;
    recorded.left_out = 3;
    recorded.unreadable = 1;
    recorded.files = {"/a/b.0001.rawlog", "c \"d\"\n.rawlog"};
    recorded.older_files = {"/a/b.0003.rawlog"};
    recorded.failure = "disk: is full";
    sendLine(ends_[0], readyLine());
    sendLine(ends_[0], failedLine("x.rawlog: exists"));
    sendLine(ends_[0], lineOf(recorded));
    ASSERT_EQ(write(ends_[0], "{\"turns\": 1", 11), 11);
    shutdown(ends_[0], SHUT_WR);
    std::string line;
    ASSERT_TRUE(readLine(ends_[1], line));
    EXPECT_EQ(failureIn(line), "");
    ASSERT_TRUE(readLine(ends_[1], line));
    EXPECT_EQ(failureIn(line), "x.rawlog: exists");
    EXPECT_THAT(test::messageOf([&] { recordedIn(line); }), HasSubstr("turns"));
    ASSERT_TRUE(readLine(ends_[1], line));
    const Recorded read = recordedIn(line);
    EXPECT_EQ(read.turns, 12u);
    EXPECT_EQ(read.left_out, 3u);
    EXPECT_EQ(read.unreadable, 1u);
    EXPECT_EQ(read.files, recorded.files);
    EXPECT_EQ(read.older_files, recorded.older_files);
    EXPECT_EQ(read.failure, "disk: is full");
    EXPECT_FALSE(readLine(ends_[1], line));
}

}  // namespace
}  // namespace hagen::live
