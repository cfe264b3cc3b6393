#include <gtest/gtest.h>
#include <hagen/sensors/VelodyneCalibration.h>
#include <hagen/sensors/VelodyneModel.h>

#include <cmath>
#include <stdexcept>

#include "support/LaserRows.h"

namespace hagen::sensors {
namespace {

TEST(VelodyneModel, DefaultBeamsMatchDataSheets) {
    for (const char* name : {"VLP-16", "Puck Hi-Res", "HDL-32E", "VLP-32C", "VLS-128"}) {
        const auto& calibration = defaultCalibration(velodyneModel(name));
        const SensorModel expected = sensorModel(name), found = sensorOf(calibration, name);
        ASSERT_EQ(found.rows(), expected.rows());
        for (int row = 0; row < found.rows(); ++row) {
            EXPECT_NEAR(found.elevations_rad[row], expected.elevations_rad[row], 1e-3) << name;
        }
    }
}

TEST(VelodyneModel, RowsFollowElevation) {
    const auto rows = test::rowsOfLasers(defaultCalibration(velodyneModel("VLP-16")));
    // The VLP-16 fires in the order -15, 1, -13, 3, ... degrees.
    EXPECT_EQ(rows,
              (std::vector<std::uint8_t>{0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15}));
}

TEST(VelodyneModel, BlockHasThirtyTwoReturns) {
    for (const char* name : {"VLP-16", "Puck Hi-Res", "HDL-32E", "VLP-32C", "VLS-128"}) {
        const VelodyneModel& model = velodyneModel(name);
        EXPECT_EQ(model.lasers * model.firings_per_block, 32 * model.banks());
        EXPECT_EQ(model.turnWithinBlock(0, 0), 0.0);
        EXPECT_LT(model.turnWithinBlock(model.firings_per_block - 1, model.lasers - 1), 1.0);
        EXPECT_EQ(findVelodyneModel(model.id), &model);
    }
}

TEST(VelodyneModel, FiringTimesMatchManuals) {
    EXPECT_EQ(velodyneModel("VLP-16").laser_period_us, 2.304);
    EXPECT_EQ(velodyneModel("VLP-16").firing_period_us, 55.296);
    EXPECT_EQ(velodyneModel("HDL-32E").laser_period_us, 1.152);
    EXPECT_EQ(velodyneModel("HDL-32E").firing_period_us, 46.080);
    // A VLP-32C fires two lasers at a time; the last pair fires 15 periods after the first.
    EXPECT_EQ(velodyneModel("VLP-32C").delayUs(1), 0.0);
    EXPECT_DOUBLE_EQ(velodyneModel("VLP-32C").delayUs(31), 15 * 2.304);
    // A VLS-128 fires eight, and pauses for one period after 64.
    EXPECT_DOUBLE_EQ(velodyneModel("VLS-128").delayUs(63), 7 * 2.665);
    EXPECT_DOUBLE_EQ(velodyneModel("VLS-128").delayUs(64), 9 * 2.665);
    EXPECT_DOUBLE_EQ(velodyneModel("VLS-128").packetPeriodUs(false), 3 * 53.3);
    EXPECT_DOUBLE_EQ(velodyneModel("VLS-128").packetPeriodUs(true), 53.3);
    EXPECT_DOUBLE_EQ(hdl64Model().packetPeriodUs(false), 288.0);
    EXPECT_DOUBLE_EQ(velodyneModel("VLP-16").packetPeriodUs(false), 1327.104);
    EXPECT_DOUBLE_EQ(velodyneModel("VLP-16").packetPeriodUs(true), 663.552);
    EXPECT_DOUBLE_EQ(velodyneModel("HDL-32E").packetPeriodUs(false), 552.96);
    EXPECT_DOUBLE_EQ(velodyneModel("VLP-32C").packetPeriodUs(false), 663.552);
}

TEST(VelodyneModel, Vlp32cHasAzimuthOffsets) {
    const auto& lasers = defaultCalibration(velodyneModel("VLP-32C")).lasers;
    double sum = 0;
    for (const auto& laser : lasers) {
        const double offset_deg = std::abs(laser.azimuth_deg);
        EXPECT_TRUE(offset_deg == 1.4 || offset_deg == 4.2);
        sum += laser.azimuth_deg;
    }
    EXPECT_NEAR(sum, 0.0, 1e-9);
    EXPECT_EQ(lasers[0].azimuth_deg, -1.4);  // the decoder subtracts it, the manual adds 1.4
    EXPECT_NEAR(lasers[3].elevation_sine, std::sin(-15.639 * M_PI / 180), 1e-12);
}

TEST(VelodyneModel, AzimuthReadingsAreClockwise) {
    for (const double reading :
         {0.0, 4500.0, 9000.0, 17999.0, 27000.0, 35999.0, -9000.0, 45000.0}) {
        const double turned = std::remainder(azimuthOfReadingDeg(reading) - 0.01 * reading, 360.0);
        EXPECT_GE(turned, 0.0);
        EXPECT_LE(turned, 0.01 + 1e-9);
        EXPECT_LE(std::abs(azimuthOfReadingDeg(reading)), 180.02);
    }
}

TEST(VelodyneModel, RejectsOtherModels) {
    EXPECT_EQ(findVelodyneModel(0x63), nullptr);
    EXPECT_THROW(velodyneModel("HDL-64E"), std::invalid_argument);
}

}  // namespace
}  // namespace hagen::sensors
