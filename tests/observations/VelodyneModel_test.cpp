#include <gtest/gtest.h>
#include <hagen/observations/VelodyneModel.h>

#include <cmath>
#include <stdexcept>

namespace hagen::observations {
namespace {

using mrpt::obs::VelodyneCalibration;

TEST(VelodyneModel, DefaultCalibrationsHaveTheBeamsOfTheDataSheets) {
    for (const char* name : {"VLP-16", "HDL-32E"}) {
        const auto& calibration =
            VelodyneCalibration::LoadDefaultCalibration(velodyneModel(name).calibration);
        const SensorModel expected = sensorModel(name), found = sensorOf(calibration, name);
        ASSERT_EQ(found.rows(), expected.rows());
        for (int row = 0; row < found.rows(); ++row) {
            EXPECT_NEAR(found.elevations_rad[row], expected.elevations_rad[row], 1e-3) << name;
        }
    }
}

TEST(VelodyneModel, RowsFollowElevationNotLaserNumber) {
    const auto rows = rowsOfLasers(VelodyneCalibration::LoadDefaultCalibration("VLP16"));
    // The VLP-16 fires at -15, 1, -13, 3, ... degrees.
    EXPECT_EQ(rows,
              (std::vector<std::uint8_t>{0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15}));
}

TEST(VelodyneModel, ABlockHoldsThirtyTwoReturns) {
    for (const char* name : {"VLP-16", "HDL-32E"}) {
        const VelodyneModel& model = velodyneModel(name);
        EXPECT_EQ(model.lasers * model.firings_per_block, 32);
        EXPECT_EQ(model.turnWithinBlock(0, 0), 0.0);
        EXPECT_LT(model.turnWithinBlock(model.firings_per_block - 1, model.lasers - 1), 1.0);
        EXPECT_EQ(findVelodyneModel(model.id), &model);
    }
}

TEST(VelodyneModel, FiresAsTheManualsSay) {
    EXPECT_EQ(velodyneModel("VLP-16").laser_period_us, 2.304);
    EXPECT_EQ(velodyneModel("VLP-16").firing_period_us, 55.296);
    EXPECT_EQ(velodyneModel("HDL-32E").laser_period_us, 1.152);
    EXPECT_EQ(velodyneModel("HDL-32E").firing_period_us, 46.080);
}

TEST(VelodyneModel, AzimuthReadingsGoClockwiseAroundTheTurn) {
    for (const double reading :
         {0.0, 4500.0, 9000.0, 17999.0, 27000.0, 35999.0, -9000.0, 45000.0}) {
        const double turned = std::remainder(azimuthOfReadingDeg(reading) - 0.01 * reading, 360.0);
        EXPECT_GE(turned, 0.0);
        EXPECT_LE(turned, 0.01 + 1e-9);
        EXPECT_LE(std::abs(azimuthOfReadingDeg(reading)), 180.02);
    }
}

TEST(VelodyneModel, OtherModelsAreNotKnown) {
    EXPECT_EQ(findVelodyneModel(0x28), nullptr);  // VLP-32C: different packets
    EXPECT_THROW(velodyneModel("HDL-64E"), std::invalid_argument);
}

}  // namespace
}  // namespace hagen::observations
