#include "sensors/ouster/OusterColumns.h"
#include <gtest/gtest.h>

#include "support/OusterModes.h"

namespace hagen::sensors {
namespace {

using test::OusterMode;
using test::TurningOuster;

const OusterMode kMode{1024, 10};
const OusterMode kOthers[] = {{512, 10}, {2048, 10}, {512, 20}, {4096, 5}};

class OusterColumnsTest : public testing::Test {
 protected:
    /// Number of packets with certain columns in a number of turns.
    std::size_t certain(const OusterMode& mode, int turns) {
        std::size_t count = 0;
        for (int k = 0; k < turns; ++k) {
            for (const std::string& packet : ouster_.turn(mode)) {
                count += columns_.take(reinterpret_cast<const std::uint8_t*>(packet.data()));
            }
        }
        return count;
    }

    const OusterSensor sensor_ = ousterSensorOf(test::ousterJsonOf(kMode), "test");
    TurningOuster ouster_;
    OusterColumns columns_{sensor_};
};

TEST_F(OusterColumnsTest, MetadataColumnsAreCertain) {
    EXPECT_EQ(certain(kMode, 5), 5 * 64u);
    ouster_.setClock(5000000000000);
    EXPECT_EQ(certain(kMode, 3), 3 * 64u);  // after a clock step
    ouster_.setClock(0);
    EXPECT_EQ(certain(kMode, 3), 3 * 64u);
    EXPECT_EQ(columns_.restarts(), 0u);
}

TEST_F(OusterColumnsTest, DetectsOtherModeImmediately) {
    for (const OusterMode& mode : {kOthers[0], kOthers[1]}) {
        TurningOuster ouster;
        OusterColumns columns(sensor_);
        const auto certainOf = [&](const OusterMode& now) {
            std::size_t count = 0;
            for (const std::string& packet : ouster.turn(now)) {
                count += columns.take(reinterpret_cast<const std::uint8_t*>(packet.data()));
            }
            return count;
        };
        EXPECT_EQ(certainOf(kMode), 64u);
        EXPECT_EQ(certainOf(kMode), 64u);
        for (int k = 0; k < 4; ++k) EXPECT_EQ(certainOf(mode), 0u) << mode.text();
        certainOf(kMode);
        EXPECT_EQ(certainOf(kMode), 64u) << mode.text();
    }
}

/// If the column rate does not change, the initialization number shows the restart.
TEST_F(OusterColumnsTest, RestartMakesColumnsUncertain) {
    for (const OusterMode& mode : kOthers) {
        certain(kMode, 3);
        ++ouster_.initialization;
        EXPECT_EQ(certain(mode, 5), 0u) << mode.text();
        ++ouster_.initialization;
        EXPECT_EQ(certain(kMode, 3), 2 * 64u);
    }
    EXPECT_EQ(columns_.restarts(), 8u);
}

/// The first turn is lost, because its duration is still unknown.
TEST_F(OusterColumnsTest, SpeedDoesNotChangeMode) {
    certain(kMode, 3);
    EXPECT_EQ(certain({1024, 20}, 3), 2 * 64u);
}

TEST_F(OusterColumnsTest, FirstTurnUsesMetadataMode) {
    EXPECT_EQ(certain({2048, 10}, 4), 0u);
    TurningOuster other;
    OusterColumns columns(sensor_);
    for (const std::string& packet : other.turn({512, 10})) {
        EXPECT_FALSE(columns.take(reinterpret_cast<const std::uint8_t*>(packet.data())));
    }
}

TEST_F(OusterColumnsTest, LegacyPacketsUseEncoder) {
    const OusterSensor sensor = ousterSensorOf(test::ousterJsonOf(kMode, "LEGACY"), "test");
    TurningOuster ouster("LEGACY");
    OusterColumns columns(sensor);
    for (const OusterMode& mode : kOthers) {
        for (const OusterMode& now : {kMode, mode}) {
            for (const std::string& packet : ouster.turn(now)) {
                const bool is_certain =
                    columns.take(reinterpret_cast<const std::uint8_t*>(packet.data()));
                EXPECT_EQ(is_certain, now.columns == 1024) << mode.text();
            }
        }
    }
}

/// In an unknown mode, excessive column numbers invalidate the turn.
TEST_F(OusterColumnsTest, LargeColumnNumbersSignalOtherMode) {
    OusterSensor sensor = sensor_;
    sensor.turn_s = 0;
    OusterColumns columns(sensor);
    const auto packets = ouster_.turn({2048, 10});
    for (std::size_t p = 0; p < packets.size(); ++p) {
        EXPECT_EQ(columns.take(reinterpret_cast<const std::uint8_t*>(packets[p].data())), p < 64);
    }
}

}  // namespace
}  // namespace hagen::sensors
