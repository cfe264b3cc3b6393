#include "scan/AirframeLearner.h"
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>

#include <cmath>
#include <functional>
#include <stdexcept>

#include "support/Random.h"

namespace hagen {
namespace {

void addReturn(double azimuth_deg, double elevation_deg, double range_m, Scan& scan) {
    const double azimuth = radians(azimuth_deg), elevation = radians(elevation_deg);
    scan.x_m.push_back(static_cast<float>(range_m * std::cos(elevation) * std::cos(azimuth)));
    scan.y_m.push_back(static_cast<float>(range_m * std::cos(elevation) * std::sin(azimuth)));
    scan.z_m.push_back(static_cast<float>(range_m * std::sin(elevation)));
    scan.range_m.push_back(static_cast<float>(range_m));
}

LearnedAirframe learnedFrom(int scans, const std::function<void(int, Scan&)>& fill) {
    AirframeLearner learner;
    for (int number = 0; number < scans; ++number) {
        Scan scan;
        fill(number, scan);
        learner.add(scan);
    }
    EXPECT_EQ(learner.scans(), scans);
    return learner.learn();
}

/// The masked range in a direction; 0 if not masked.
float rangeAt(const LearnedAirframe& learned, double azimuth_deg, double elevation_deg) {
    const auto row = static_cast<Eigen::Index>((elevation_deg + 90) / 2);
    const auto column = static_cast<Eigen::Index>((azimuth_deg + 180) / 2);
    return learned.bin_range_m(row, column);
}

TEST(AirframeLearner, LearnsConstantNearRanges) {
    test::Random random(5);
    const LearnedAirframe learned = learnedFrom(40, [&](int number, Scan& scan) {
        addReturn(31, 11, 0.5 + 0.001 * (number % 10), scan);  // a leg
        if (number % 2 == 0) addReturn(71, 11, 0.7, scan);     // in half of the scans
        if (number % 5 < 2) addReturn(111, 11, 0.7, scan);     // in less than half
        addReturn(-91, 11, random.real(0.3f, 1.4f), scan);     // a passing object
        addReturn(-131, 11, 1.6, scan);                        // too far
        addReturn(-171, -31, 8, scan);                         // the ground
    });
    EXPECT_EQ(learned.bins, 2);
    EXPECT_NEAR(rangeAt(learned, 31, 11), 0.508 + 0.1, 1e-4);
    EXPECT_NEAR(rangeAt(learned, 71, 11), 0.7 + 0.1, 1e-5);
    EXPECT_EQ((learned.bin_range_m > 0).count(), 2);
}

TEST(AirframeLearner, LearnsEdges) {
    const LearnedAirframe learned = learnedFrom(50, [](int number, Scan& scan) {
        addReturn(179, 11, 0.5, scan);
        if (number % 10 == 0) addReturn(-179, 13, 0.52, scan);  // adjacent across the seam
        if (number % 10 == 1) addReturn(-177, 13, 0.52, scan);  // adjacent to the previous bin
        if (number % 10 == 2) addReturn(179, 9, 1.2, scan);     // adjacent, but farther
        if (number == 3) addReturn(177, 11, 0.5, scan);         // seen once only
        if (number % 10 == 4) addReturn(100, 11, 0.5, scan);    // not adjacent
    });
    EXPECT_EQ(learned.bins, 3);
    EXPECT_NEAR(rangeAt(learned, -179, 13), 0.6, 1e-5);
    EXPECT_NEAR(rangeAt(learned, -177, 13), 0.6, 1e-5);
}

TEST(AirframeLearner, SharesAreSolidAngles) {
    const LearnedAirframe learned = learnedFrom(10, [](int, Scan& scan) {
        for (int azimuth_deg = -179; azimuth_deg < 180; azimuth_deg += 2) {
            for (int elevation_deg = -29; elevation_deg < 0; elevation_deg += 2)
                addReturn(azimuth_deg, elevation_deg, 0.5, scan);
            for (int elevation_deg = 1; elevation_deg < 90; elevation_deg += 2)
                addReturn(azimuth_deg, elevation_deg, 9, scan);
        }
    });
    EXPECT_EQ(learned.bins, 180 * 15);
    EXPECT_NEAR(learned.share_of_sphere, 0.25, 1e-9);  // sin(30 deg) / 2
    EXPECT_NEAR(learned.share_of_seen, 0.25 / 0.75, 1e-9);
}

TEST(AirframeLearner, LearnedBinsMaskReturns) {
    test::Random random(6);
    const auto fill = [&](int, Scan& scan) {
        for (int i = 0; i < 30; ++i)
            addReturn(random.real(40, 50), random.real(-20, -5), random.real(0.4f, 0.44f), scan);
        for (int i = 0; i < 30; ++i)
            addReturn(random.real(-180, 180), random.real(-20, 20), random.real(0.7f, 20), scan);
    };
    Airframe airframe;
    airframe.bin_range_m = learnedFrom(100, fill).bin_range_m;
    Scan scan;
    fill(0, scan);
    EXPECT_EQ(maskAirframe(airframe, scan), 30u);
}

TEST(AirframeLearner, IgnoresEmptyScansAndMissingRanges) {
    const LearnedAirframe learned = learnedFrom(10, [](int, Scan& scan) {
        addReturn(0, 0, 0.5, scan);
        scan.range_m.back() = kNoValue;
    });
    EXPECT_EQ(learned.bins, 0);
    EXPECT_EQ(learned.share_of_seen, 0);
}

TEST(AirframeLearner, RejectsTooFewScans) {
    AirframeLearner learner;
    for (int i = 0; i < 9; ++i) learner.add({});
    EXPECT_THROW(learner.learn(), std::invalid_argument);
    learner.add({});
    EXPECT_NO_THROW(learner.learn());
}

}  // namespace
}  // namespace hagen
