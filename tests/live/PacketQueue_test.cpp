#include <gtest/gtest.h>
#include <hagen/live/PacketQueue.h>

#include <set>
#include <thread>

namespace hagen::live {
namespace {

using Popped = PacketQueue::Popped;
constexpr std::chrono::microseconds kSoon(100);

Packet packetOf(std::uint8_t number) {
    Packet packet;
    packet.bytes = {number};
    packet.to_port = number;
    return packet;
}

TEST(PacketQueue, KeepsOrderAndRejectsOverflow) {
    PacketQueue queue(3);
    Packet packet;
    EXPECT_EQ(queue.pop(packet, kSoon), Popped::Nothing);
    for (std::uint8_t i = 0; i < 5; ++i) {
        Packet sent = packetOf(i);
        EXPECT_EQ(queue.push(sent), i < 3);
    }
    for (std::uint8_t i = 0; i < 3; ++i) {
        ASSERT_EQ(queue.pop(packet, kSoon), Popped::Packet);
        EXPECT_EQ(packet.bytes, std::vector<std::uint8_t>{i});
        EXPECT_EQ(packet.to_port, i);
    }
    EXPECT_EQ(queue.pop(packet, kSoon), Popped::Nothing);
}

TEST(PacketQueue, AllocatesForWaitingPacketsOnly) {
    PacketQueue queue(100);
    Packet sent, taken;
    std::set<const std::uint8_t*> memory;
    for (int k = 0; k < 300; ++k) {
        for (int i = 0; i < 3; ++i) {
            sent.bytes.resize(1206);
            memory.insert(sent.bytes.data());
            ASSERT_TRUE(queue.push(sent));
        }
        for (int i = 0; i < 3; ++i) ASSERT_EQ(queue.pop(taken, kSoon), Popped::Packet);
    }
    EXPECT_LE(memory.size(), 5u);  // three waiting packets, and one at each end
}

TEST(PacketQueue, DrainsAfterClose) {
    PacketQueue queue(3);
    Packet packet = packetOf(7);
    queue.push(packet);
    queue.close();
    Packet late = packetOf(8);
    EXPECT_FALSE(queue.push(late));
    EXPECT_FALSE(queue.pushOrWait(late));
    EXPECT_EQ(queue.pop(packet, kSoon), Popped::Packet);
    EXPECT_EQ(packet.to_port, 7);
    EXPECT_EQ(queue.pop(packet, kSoon), Popped::Closed);
}

TEST(PacketQueue, LosesNoPacketBetweenThreads) {
    PacketQueue queue(4);
    std::thread sender([&] {
        for (int i = 0; i < 5000; ++i) {
            Packet packet;
            packet.time_ns = i;
            EXPECT_TRUE(queue.pushOrWait(packet));
        }
        queue.close();
    });
    Packet packet;
    std::int64_t next = 0;
    while (queue.pop(packet, std::chrono::seconds(10)) == Popped::Packet) {
        EXPECT_EQ(packet.time_ns, next++);
    }
    sender.join();
    EXPECT_EQ(next, 5000);
}

}  // namespace
}  // namespace hagen::live
