#include <gtest/gtest.h>
#include <hagen/filter/Levelling.h>
#include <hagen/live/TurnMotion.h>
#include <hagen/scan/Angle.h>

#include <cmath>

#include "support/Random.h"
#include "support/SimpleScene.h"

namespace hagen::live {
namespace {

constexpr int kTurnColumns = 870, kSectors = 24;

/// A sensor above a plane that moves by the same step in each turn.
struct StraightFlight {
    Eigen::Isometry3d plane_from_sensor = Eigen::Isometry3d(Eigen::Translation3d(0, 0, 2.5));
    Eigen::Isometry3d then_from_now = Eigen::Isometry3d::Identity();  ///< one turn apart
    double noise_m = 0;
    double outliers = 0;  ///< share of the returns that are 0.5 to 2 m nearer
};

Eigen::Isometry3d stepOf(double roll_deg, double pitch_deg, double rise_m) {
    const Eigen::Vector3d turn(radians(roll_deg), radians(pitch_deg), 0);
    Eigen::Isometry3d step(Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()));
    step.translation().z() = rise_m;
    return step;
}

/// `step` scaled to a number of turns.
Eigen::Isometry3d part(const Eigen::Isometry3d& step, double turns) {
    const Eigen::AngleAxisd turn(step.linear());
    Eigen::Isometry3d motion(Eigen::AngleAxisd(turns * turn.angle(), turn.axis()));
    motion.translation() = turns * step.translation();
    return motion;
}

class TurnMotionTest : public testing::Test {
 protected:
    /// Returns of the plane in a sector, all ROU, each from the sensor's position at its time.
    Scan sweep(const StraightFlight& flight, int sector) {
        Scan scan;
        for (int k = 0; k < kTurnColumns / kSectors; ++k) {
            const int column = sector % kSectors * (kTurnColumns / kSectors) + k;
            const double azimuth_rad = kPi - (column + 0.5) * kTurn_rad / kTurnColumns;
            const double turns =
                (sector + static_cast<double>(k) * kSectors / kTurnColumns) / kSectors;
            const Eigen::Isometry3d pose =
                flight.plane_from_sensor * part(flight.then_from_now, turns);
            for (int row = 0; row < sensor_.rows(); ++row) {
                const Eigen::Vector3d ray = test::directionOf(
                    azimuth_rad, static_cast<double>(sensor_.elevations_rad[row]));
                const double fall = (pose.linear() * ray).z();
                double range_m = -pose.translation().z() / fall;
                if (!(fall < 0) || range_m > 50) continue;
                range_m += flight.noise_m * static_cast<double>(random_.real(-1, 1));
                if (random_.chance(flight.outliers)) {
                    range_m -= static_cast<double>(random_.real(0.5F, 2));
                }
                scan.x_m.push_back(static_cast<float>(range_m * ray.x()));
                scan.y_m.push_back(static_cast<float>(range_m * ray.y()));
                scan.z_m.push_back(static_cast<float>(range_m * ray.z()));
                scan.range_m.push_back(static_cast<float>(range_m));
                scan.azimuth_rad.push_back(static_cast<float>(azimuth_rad));
                scan.row.push_back(static_cast<std::uint8_t>(row));
            }
        }
        return scan;
    }

    void fly(const StraightFlight& flight, int sectors, Label label = Label::Rou) {
        for (int k = 0; k < sectors; ++k, ++swept_) {
            const Scan scan = sweep(flight, swept_);
            motion_.add(scan, std::vector<Label>(scan.size(), label),
                        (swept_ + 1) * kTurn_rad / kSectors);
        }
    }

    /// Maximum height error of ground points 10 m away after applying the estimated motion.
    double worstHeight_m(const StraightFlight& flight, double turns) const {
        const auto estimated = motion_.since(turns);
        if (!estimated) return std::nan("");
        const Eigen::Isometry3d truth = part(flight.then_from_now, -turns);
        const Eigen::Isometry3d now =
            flight.plane_from_sensor * part(flight.then_from_now, double(swept_) / kSectors);
        double worst_m = 0;
        for (int k = 0; k < 12; ++k) {
            const double azimuth_rad = k * kTurn_rad / 12;
            const Eigen::Vector3d place_m =
                10 * test::directionOf(azimuth_rad, std::atan2(-2.5, 10.0));
            const Eigen::Vector3d apart_m = now.linear() * (*estimated * place_m - truth * place_m);
            worst_m = std::max(worst_m, std::abs(apart_m.z()));
        }
        return worst_m;
    }

    const SensorModel sensor_ = sensorModel("VLP-16");
    TurnMotion motion_{sensor_.rows(), kTurnColumns, 20};
    test::Random random_{1};
    int swept_ = 0;
};

TEST_F(TurnMotionTest, UnknownBeforeSecondTurn) {
    EXPECT_FALSE(motion_.since(1));
    fly({}, kSectors);
    EXPECT_FALSE(motion_.since(1));
    fly({}, kSectors);
    ASSERT_TRUE(motion_.since(1));
    EXPECT_LT(worstHeight_m({}, 1), 1e-3);
}

TEST_F(TurnMotionTest, FindsTiltAndRise) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        random_ = test::Random(seed);
        motion_.forget();
        swept_ = 0;
        StraightFlight flight;
        flight.noise_m = 0.03;
        flight.then_from_now = stepOf(static_cast<double>(random_.real(-3, 3)),
                                      static_cast<double>(random_.real(-3, 3)),
                                      static_cast<double>(random_.real(-0.1F, 0.1F)));
        fly(flight, 3 * kSectors);
        // At 10 m, the motion is up to 0.8 m (4 degrees).
        EXPECT_LT(worstHeight_m(flight, 1), 0.1);
        EXPECT_LT(worstHeight_m(flight, 0.5), 0.05);
    }
}

TEST_F(TurnMotionTest, DownweightsOutliers) {
    StraightFlight flight;
    flight.then_from_now = stepOf(1, -2, 0.05);
    fly(flight, 2 * kSectors);
    flight.outliers = 0.2;
    fly(flight, kSectors);
    EXPECT_LT(worstHeight_m(flight, 1), 0.1);
}

TEST_F(TurnMotionTest, SlopeIsNotTilt) {
    StraightFlight flight;
    flight.plane_from_sensor.linear() =
        levelFromSensor({static_cast<float>(radians(10.0)), static_cast<float>(radians(-8.0))})
            .cast<double>();
    fly(flight, 3 * kSectors);
    EXPECT_LT(worstHeight_m(flight, 1), 1e-3);
    flight.then_from_now = stepOf(-1, 1, 0);
    fly(flight, 3 * kSectors);
    EXPECT_LT(worstHeight_m(flight, 1), 0.1);
}

TEST_F(TurnMotionTest, FindsMotionLookingDown) {
    StraightFlight flight;
    flight.plane_from_sensor.linear() =
        levelFromSensor({0, static_cast<float>(radians(40.0))}).cast<double>();
    flight.then_from_now = stepOf(2, 1, 0);
    fly(flight, 3 * kSectors);
    EXPECT_LT(worstHeight_m(flight, 1), 0.1);
}

TEST_F(TurnMotionTest, IgnoresGroundBeyondZone) {
    motion_ =
        TurnMotion(sensor_.rows(), kTurnColumns, 9);  // the first ring of ground is 9.7 m away
    fly({}, 3 * kSectors);
    EXPECT_FALSE(motion_.since(1));
}

TEST_F(TurnMotionTest, IgnoresSameTurn) {
    fly({}, kSectors);
    --swept_;
    fly({}, 1);
    EXPECT_FALSE(motion_.since(1));
}

TEST_F(TurnMotionTest, UsesGroundOnly) {
    fly({}, 3 * kSectors, Label::Roi);
    EXPECT_FALSE(motion_.since(1));
}

TEST_F(TurnMotionTest, ForgetsWithoutGround) {
    fly({}, 3 * kSectors);
    EXPECT_TRUE(motion_.since(1));
    fly({}, kSectors, Label::Roi);
    EXPECT_FALSE(motion_.since(1));
    // Earlier turns are not used.
    fly({}, kSectors);
    EXPECT_FALSE(motion_.since(1));
}

TEST_F(TurnMotionTest, IgnoresPixelsNotSeenBefore) {
    fly({}, kSectors);
    swept_ += kSectors;
    fly({}, kSectors);
    EXPECT_FALSE(motion_.since(1));
}

}  // namespace
}  // namespace hagen::live
