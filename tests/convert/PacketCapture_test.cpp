#include "convert/PacketCapture.h"

#include <gmock/gmock.h>
#include <hagen/sensors/CaptureFile.h>

#include "support/BagWriter.h"
#include "support/OusterPackets.h"
#include "support/Program.h"

namespace hagen::convert {
namespace {

TEST(PacketCapture, KeepsOusterPacketsOfBag) {
    const test::TemporaryFolder folder;
    const auto sensor = sensors::ousterSensorOf(test::ousterJson(), "here");
    std::vector<std::string> packets;
    std::vector<test::SentMessage> messages{
        test::stringMessage("/ouster/metadata", 1, test::ousterJson())};
    for (const std::string& packet : test::packetsOf(sensor, test::randomFrame(sensor, 1))) {
        packets.push_back(packet);
        messages.push_back(test::sentMessage("/ouster/lidar_packets", "ouster_ros/PacketMsg", 2,
                                             [&](auto& to) { to.counted(packet); }));
    }
    const auto bag = folder.write("a.bag", test::ros1BagOf(messages));
    EXPECT_EQ(capturePackets(bag, {}, folder / "a.pcap", false), packets.size());
    sensors::CaptureFile capture(folder / "a.pcap");
    sensors::Datagram datagram;
    for (const std::string& packet : packets) {
        ASSERT_TRUE(capture.next(datagram));
        EXPECT_EQ(std::string(datagram.bytes, datagram.bytes + datagram.size), packet);
        EXPECT_EQ(datagram.time_ns, 2000000000);
        EXPECT_EQ(datagram.to_port, 7502);
    }
    EXPECT_FALSE(capture.next(datagram));
    EXPECT_THAT(
        test::messageOf([&] { capturePackets(folder / "a.pcap", {}, folder / "b.pcap", false); }),
        testing::HasSubstr("is a capture already"));
}

}  // namespace
}  // namespace hagen::convert
