#include "mrpt/VelodyneEncoder.h"
#include <gtest/gtest.h>

#include <stdexcept>

namespace hagen::observations {
namespace {

Firings firingsAt(float range_m, int lasers, int count) {
    Firings firings;
    firings.range_m.setConstant(lasers, count, range_m);
    firings.intensity.setConstant(lasers, count, 1.0f);
    return firings;
}

// VelodyneDecoder_test.cpp tests that decoding inverts encoding; these tests check the raw bytes.
TEST(VelodyneEncoder, MatchesManual) {
    Firings firings = firingsAt(10.0f, 16, 24);
    firings.first_azimuth_deg = 359.9;
    firings.first_time_us = 1234567;
    const auto packets = encodePackets(sensors::velodyneModel("VLP-16"), firings);
    ASSERT_EQ(packets.size(), 1u);
    EXPECT_EQ(packets[0].blocks[0].header(), 0xeeff);
    EXPECT_EQ(packets[0].blocks[0].rotation(), 35990);
    EXPECT_EQ(packets[0].blocks[1].rotation(), 30);  // two firings later, across north
    EXPECT_EQ(packets[0].blocks[3].laser_returns[7].distance(), 5000);
    EXPECT_EQ(packets[0].blocks[3].laser_returns[7].intensity(), 255);
    EXPECT_EQ(packets[0].gps_timestamp(), 1234567u);
    EXPECT_EQ(packets[0].laser_return_mode, 0x37);
    EXPECT_EQ(packets[0].velodyne_model_ID, 0x22);
}

TEST(VelodyneEncoder, DualModeRepeatsBlocks) {
    Firings firings = firingsAt(10.0f, 32, 12);
    firings.last_range_m = firings.range_m + 2.0f;
    const auto packets = encodePackets(sensors::velodyneModel("HDL-32E"), firings);
    ASSERT_EQ(packets.size(), 2u);
    EXPECT_EQ(packets[0].laser_return_mode, 0x39);
    EXPECT_EQ(packets[0].velodyne_model_ID, 0x21);
    EXPECT_EQ(packets[0].blocks[0].rotation(), packets[0].blocks[1].rotation());
    EXPECT_EQ(packets[0].blocks[0].laser_returns[0].distance(), 6000);
    EXPECT_EQ(packets[0].blocks[1].laser_returns[0].distance(), 5000);
}

TEST(VelodyneEncoder, DropsUnrepresentableRanges) {
    for (const float range_m : {0.0f, -1.0f, 131.1f, 1e9f, kNoValue}) {
        const auto packets =
            encodePackets(sensors::velodyneModel("VLP-16"), firingsAt(range_m, 16, 24));
        EXPECT_EQ(packets[0].blocks[0].laser_returns[0].distance(), 0) << range_m;
    }
    const auto packets =
        encodePackets(sensors::velodyneModel("VLP-16"), firingsAt(131.07f, 16, 24));
    EXPECT_EQ(packets[0].blocks[0].laser_returns[0].distance(), 65535);
}

TEST(VelodyneEncoder, WrapsAzimuthsAndClampsIntensities) {
    Firings firings = firingsAt(10.0f, 16, 24);
    firings.first_azimuth_deg = -10.0;
    firings.intensity.setConstant(7.0f);
    firings.intensity(3, 0) = kNoValue;
    const auto packets = encodePackets(sensors::velodyneModel("VLP-16"), firings);
    EXPECT_EQ(packets[0].blocks[0].rotation(), 35000);
    EXPECT_EQ(packets[0].blocks[0].laser_returns[0].intensity(), 255);
    EXPECT_EQ(packets[0].blocks[0].laser_returns[3].intensity(), 0);
}

TEST(VelodyneEncoder, PadsLastPacket) {
    const auto packets = encodePackets(sensors::velodyneModel("VLP-16"), firingsAt(10.0f, 16, 25));
    ASSERT_EQ(packets.size(), 2u);
    EXPECT_EQ(packets[1].blocks[0].laser_returns[15].distance(), 5000);
    EXPECT_EQ(packets[1].blocks[0].laser_returns[16].distance(), 0);
    EXPECT_EQ(packets[1].blocks[11].laser_returns[31].distance(), 0);
}

TEST(VelodyneEncoder, RejectsOtherSensors) {
    EXPECT_THROW(encodePackets(sensors::velodyneModel("VLP-16"), firingsAt(1.0f, 32, 24)),
                 std::invalid_argument);
    Firings firings = firingsAt(1.0f, 16, 24);
    firings.intensity.resize(16, 23);
    EXPECT_THROW(encodePackets(sensors::velodyneModel("VLP-16"), firings), std::invalid_argument);
    firings = firingsAt(1.0f, 16, 24);
    firings.last_range_m.setZero(16, 2);
    EXPECT_THROW(encodePackets(sensors::velodyneModel("VLP-16"), firings), std::invalid_argument);
}

}  // namespace
}  // namespace hagen::observations
