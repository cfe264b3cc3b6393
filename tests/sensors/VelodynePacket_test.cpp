#include <gtest/gtest.h>
#include <hagen/sensors/VelodynePacket.h>

#include <utility>

namespace hagen::sensors {
namespace {

/// A packet whose blocks have this header and azimuths 0, 40, 80 ...
VelodynePacket packetOf(unsigned header) {
    VelodynePacket packet{};
    for (int block = 0; block < kVelodyneBlocks; ++block) {
        std::uint8_t* const at = packet.bytes.data() + 100 * block;
        at[0] = static_cast<std::uint8_t>(header & 0xff);
        at[1] = static_cast<std::uint8_t>(header >> 8);
        at[2] = static_cast<std::uint8_t>(40 * block & 0xff);
        at[3] = static_cast<std::uint8_t>(40 * block >> 8);
    }
    return packet;
}

TEST(VelodynePacket, ReadsFooter) {
    VelodynePacket packet = packetOf(0xeeff);
    packet.bytes[1200] = 0x04;
    packet.bytes[1201] = 0x03;
    packet.bytes[1202] = 0x02;
    packet.bytes[1203] = 0x81;
    EXPECT_EQ(packet.sensorTimeUs(), 0x81020304);
    EXPECT_FALSE(packet.isDual());
    packet.bytes[1204] = 0x39;
    EXPECT_TRUE(packet.isDual());
}

TEST(VelodynePacket, BlocksOfOtherModelsHaveNoAzimuth) {
    VelodynePacket packet = packetOf(0xccff);  // the third bank of a VLS-128
    for (const auto& [id, azimuth] : {std::pair(0x22, -1), {0xa1, 40}}) {
        packet.bytes[kVelodyneModelAt] = static_cast<std::uint8_t>(id);
        EXPECT_EQ(packet.azimuthOf(1), azimuth);
    }
}

TEST(VelodynePacket, OnlySoundBlocksHaveAzimuth) {
    VelodynePacket packet = packetOf(0xeeff);
    EXPECT_EQ(packet.azimuth(), 0);
    EXPECT_EQ(packet.azimuthOf(11), 440);
    packet.bytes[0] = 0;  // invalid header
    EXPECT_EQ(packet.azimuthOf(0), -1);
    EXPECT_EQ(packet.azimuth(), 40);
    packet.bytes[102] = 0xa0;  // 36000, one turn
    packet.bytes[103] = 0x8c;
    EXPECT_EQ(packet.azimuthOf(1), -1);
    EXPECT_EQ(packet.azimuth(), 80);
    packet.bytes[102] = 0x9f;
    EXPECT_EQ(packet.azimuth(), 35999);
}

TEST(VelodynePacket, LowerBlocksIdentifyHdl64) {
    VelodynePacket packet = packetOf(0xddff);
    EXPECT_TRUE(isOfHdl64(packet.bytes.data()));
    packet.bytes[1204] = 0x39;
    EXPECT_FALSE(packet.isDual());
    EXPECT_EQ(packet.azimuthOf(1), 40);
    EXPECT_EQ(packet.azimuth(), -1);
    EXPECT_FALSE(isOfHdl64(packetOf(0xeeff).bytes.data()));
}

TEST(VelodynePacket, DataPacketsHaveSizeAndHeaders) {
    const VelodynePacket packet = packetOf(0xeeff);
    EXPECT_TRUE(isVelodyneData(packet.bytes.data(), 1206));
    EXPECT_FALSE(isVelodyneData(packet.bytes.data(), 1205));
    EXPECT_FALSE(isVelodyneData(packetOf(0).bytes.data(), 1206));
}

}  // namespace
}  // namespace hagen::sensors
