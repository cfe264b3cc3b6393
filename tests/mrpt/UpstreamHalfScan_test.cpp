// The MRPT bug described in docs/mrpt-half-scan.md.
#include <gtest/gtest.h>
#include <hagen/sensors/VelodyneModel.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cstddef>

#include "support/SimpleFirings.h"

namespace hagen::observations {
namespace {

using mrpt::obs::CObservationVelodyneScan;

constexpr const char* kFixedUpstream =
    "MRPT now decodes whole blocks: delete docs/mrpt-half-scan.md and this test";

/// Number of non-zero readings among the first `readings` of each block of 32.
std::size_t readingsIn(const CObservationVelodyneScan& scan, int readings) {
    std::size_t count = 0;
    for (const auto& packet : scan.scan_packets) {
        for (const auto& block : packet.blocks) {
            for (int i = 0; i < readings; ++i) count += block.laser_returns[i].distance() != 0;
        }
    }
    return count;
}

TEST(UpstreamHalfScan, MrptDecodesHalfOfEachBlock) {
    const sensors::VelodyneModel& model = sensors::velodyneModel("HDL-32E");
    // From 2 m, lasers above and below the horizon hit a wall or the ground.
    const test::SimpleScene scene = test::sceneOf({{{12, -10, 0}, {13, 10, 20}}});
    const auto scan = encodeScan(model, test::fireAt(scene, model, {0, 0, 2}));
    const std::size_t first_half = readingsIn(*scan, 16), all = readingsIn(*scan, 32);
    ASSERT_GT(all, first_half + 1000);
    scan->generatePointCloud();
    EXPECT_GT(scan->point_cloud.size(), 0u);
    EXPECT_LE(scan->point_cloud.size(), first_half) << kFixedUpstream;
}

}  // namespace
}  // namespace hagen::observations
