#include "live/mavlink/Frame.h"
#include <gtest/gtest.h>
#include "live/autopilot/Messages.h"

#include <string>

namespace hagen::mavlink {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::uint16_t checksumOf(const std::string& text) {
    return checksum(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

TEST(Checksum, HasPublishedCheckValues) {
    // CRC-16/MCRF4XX is the inverse of CRC-16/IBM-SDLC (X.25), whose check value is 0x906e.
    EXPECT_EQ(checksumOf("123456789"), 0x6f91);
    EXPECT_EQ(checksumOf("123456789") ^ 0xffff, 0x906e);
    EXPECT_EQ(checksumOf(""), 0xffff);
}

TEST(Checksum, ContinuesFromEarlierBytes) {
    const Bytes bytes{1, 2, 3, 200, 5};
    EXPECT_EQ(checksum(&bytes[2], 3, checksum(bytes.data(), 2)), checksum(bytes.data(), 5));
}

TEST(CrcExtra, MatchesDefinitions) {
    // Values from the generated headers of the MAVLink C library.
    EXPECT_EQ(crcExtra(0), 50);
    EXPECT_EQ(crcExtra(30), 39);
    EXPECT_EQ(crcExtra(132), 85);
    EXPECT_EQ(crcExtra(330), 23);
    EXPECT_EQ(crcExtra(11037), 130);
    EXPECT_EQ(crcExtra(3), std::nullopt);
    EXPECT_EQ(crcExtra(0xffffff), std::nullopt);
}

TEST(Encode, HeartbeatMatchesNodeMavlink) {
    Heartbeat heartbeat;
    heartbeat.custom_mode = 0x01020304;
    heartbeat.type = kTypeOnboardController;
    heartbeat.autopilot = kAutopilotInvalid;
    heartbeat.system_status = kStateActive;
    heartbeat.mavlink_version = 3;
    Frame frame = frameOf(heartbeat);
    frame.sequence = 7;
    frame.system = 1;
    frame.component = kComponentObstacleAvoidance;
    // Bytes from node-mavlink's MavLinkProtocolV2(1, 196).serialize(message, 7).
    EXPECT_EQ(encode(frame, Heartbeat::kBytes),
              (Bytes{0xfd, 0x09, 0x00, 0x00, 0x07, 0x01, 0xc4, 0x00, 0x00, 0x00, 0x04,
                     0x03, 0x02, 0x01, 0x12, 0x08, 0x00, 0x04, 0x03, 0x96, 0xda}));
}

TEST(Encode, TruncatesTrailingZeros) {
    Attitude attitude;
    attitude.time_boot_ms = 0x00020001;
    EXPECT_EQ(encode(frameOf(attitude), Attitude::kBytes)[1], 3);  // the fourth byte is also 0
    attitude.yawspeed = 1;
    EXPECT_EQ(encode(frameOf(attitude), Attitude::kBytes)[1], Attitude::kBytes);
    // At least one byte remains.
    const Bytes bytes = encode(frameOf(Attitude()), Attitude::kBytes);
    EXPECT_EQ(bytes[1], 1);
    EXPECT_EQ(bytes.size(), 10u + 1 + 2);
}

TEST(Encode, RejectsUnknownMessage) {
    Frame frame;
    frame.id = 3;
    EXPECT_THROW(encode(frame, 4), std::invalid_argument);
}

TEST(MessageOf, InvertsFrameOf) {
    ObstacleDistance message;
    message.time_usec = 1234567890123;
    for (std::size_t k = 0; k < 72; ++k) message.distances[k] = static_cast<std::uint16_t>(900 * k);
    message.max_distance = 2000;
    message.angle_offset = -2.5f;
    message.frame = kFrameBodyFrd;
    const auto read = messageOf<ObstacleDistance>(frameOf(message));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->time_usec, message.time_usec);
    EXPECT_EQ(read->distances, message.distances);
    EXPECT_EQ(read->max_distance, 2000);
    EXPECT_EQ(read->angle_offset, -2.5f);
    EXPECT_EQ(read->frame, 12);
    EXPECT_FALSE(messageOf<Heartbeat>(frameOf(message)));
}

}  // namespace
}  // namespace hagen::mavlink
