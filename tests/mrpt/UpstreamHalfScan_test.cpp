// What docs/mrpt-half-scan.md says of MRPT, with plain MRPT.
#include <gtest/gtest.h>
#include <hagen/sensors/VelodyneModel.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/serialization/CArchive.h>

#include <cstddef>

#include "support/Program.h"
#include "support/SimpleFirings.h"

namespace hagen::observations {
namespace {

using mrpt::obs::CObservationVelodyneScan;

constexpr const char* kMended =
    "MRPT decodes whole blocks now: docs/mrpt-half-scan.md and this test can go";

/// Readings other than zero in the first `readings` of each block of 32.
std::size_t readingsIn(const CObservationVelodyneScan& scan, int readings) {
    std::size_t count = 0;
    for (const auto& packet : scan.scan_packets) {
        for (const auto& block : packet.blocks) {
            for (int i = 0; i < readings; ++i) count += block.laser_returns[i].distance() != 0;
        }
    }
    return count;
}

TEST(UpstreamHalfScan, MrptGivesTheFirstHalfOfEachBlockOfAVlp16) {
    if (test::realScan().empty()) GTEST_SKIP() << "mrpt-common is not installed";
    mrpt::io::CFileGZInputStream stream(test::realScan().string());
    auto archive = mrpt::serialization::archiveFrom(stream);
    const auto scan = std::dynamic_pointer_cast<CObservationVelodyneScan>(archive.ReadObject());
    ASSERT_TRUE(scan);
    EXPECT_EQ(readingsIn(*scan, 32), 22591u);
    EXPECT_EQ(readingsIn(*scan, 16), 11305u);
    scan->generatePointCloud();
    EXPECT_EQ(scan->point_cloud.size(), 11305u) << kMended;
}

TEST(UpstreamHalfScan, MrptGivesSixteenOf32LasersOfAnHdl32) {
    const sensors::VelodyneModel& model = sensors::velodyneModel("HDL-32E");
    // From 2 m up, lasers on both sides of the horizon see the ground or a wall.
    test::SimpleScene scene;
    scene.boxes.push_back({{12, -10, 0}, {13, 10, 20}});
    const auto scan = encodeScan(model, test::fireAt(scene, model, {0, 0, 2}));
    const std::size_t first_half = readingsIn(*scan, 16), all = readingsIn(*scan, 32);
    ASSERT_GT(all, first_half + 1000);
    scan->generatePointCloud();
    EXPECT_GT(scan->point_cloud.size(), 0u);
    EXPECT_LE(scan->point_cloud.size(), first_half) << kMended;
}

}  // namespace
}  // namespace hagen::observations
