#include <gtest/gtest.h>
#include <hagen/mrpt/VelodyneCalibrations.h>

#include <cmath>

namespace hagen::observations {
namespace {

using mrpt::obs::VelodyneCalibration;
using sensors::defaultCalibration;
using sensors::velodyneModel;

const VelodyneCalibration& ofMrpt(const char* model) {
    return VelodyneCalibration::LoadDefaultCalibration(model);
}

/// Each number, to the last bit.
void expectEqual(const VelodyneCalibration& found, const VelodyneCalibration& expected) {
    ASSERT_EQ(found.laser_corrections.size(), expected.laser_corrections.size());
    for (std::size_t i = 0; i < found.laser_corrections.size(); ++i) {
        const auto &a = found.laser_corrections[i], &b = expected.laser_corrections[i];
        EXPECT_EQ(a.azimuthCorrection, b.azimuthCorrection) << i;
        EXPECT_EQ(a.verticalCorrection, b.verticalCorrection) << i;
        EXPECT_EQ(a.distanceCorrection, b.distanceCorrection) << i;
        EXPECT_EQ(a.verticalOffsetCorrection, b.verticalOffsetCorrection) << i;
        EXPECT_EQ(a.horizontalOffsetCorrection, b.horizontalOffsetCorrection) << i;
        EXPECT_EQ(a.sinVertCorrection, b.sinVertCorrection) << i;
        EXPECT_EQ(a.cosVertCorrection, b.cosVertCorrection) << i;
        EXPECT_EQ(a.sinVertOffsetCorrection, b.sinVertOffsetCorrection) << i;
        EXPECT_EQ(a.cosVertOffsetCorrection, b.cosVertOffsetCorrection) << i;
        // A recording has the bytes of a zero's sign, too.
        EXPECT_EQ(std::signbit(a.azimuthCorrection), std::signbit(b.azimuthCorrection)) << i;
        EXPECT_EQ(std::signbit(a.sinVertOffsetCorrection), std::signbit(b.sinVertOffsetCorrection))
            << i;
        EXPECT_EQ(std::signbit(a.cosVertOffsetCorrection), std::signbit(b.cosVertOffsetCorrection))
            << i;
    }
}

TEST(VelodyneCalibrations, DefaultsAreThoseOfMrpt) {
    expectEqual(mrptCalibration(defaultCalibration(velodyneModel("VLP-16"))), ofMrpt("VLP16"));
    expectEqual(mrptCalibration(defaultCalibration(velodyneModel("HDL-32E"))), ofMrpt("HDL32"));
}

TEST(VelodyneCalibrations, BackAndForthIsTheSame) {
    VelodyneCalibration calibration = ofMrpt("HDL32");
    double number = 0.01;
    for (auto& laser : calibration.laser_corrections) {
        laser.azimuthCorrection = number += 0.01;
        laser.distanceCorrection = number += 0.01;
        laser.verticalOffsetCorrection = number += 0.01;
        laser.horizontalOffsetCorrection = number += 0.01;
        laser.sinVertOffsetCorrection = laser.verticalOffsetCorrection * laser.sinVertCorrection;
        laser.cosVertOffsetCorrection = laser.verticalOffsetCorrection * laser.cosVertCorrection;
    }
    sensors::VelodyneCalibration read = defaultCalibration(velodyneModel("VLP-16"));  // replaced
    readCalibration(calibration, read);
    expectEqual(mrptCalibration(read), calibration);
}

}  // namespace
}  // namespace hagen::observations
