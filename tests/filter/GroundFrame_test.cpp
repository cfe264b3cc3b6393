#include "filter/simd/GroundFrame.h"
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>

#include <cmath>

#include "support/GroundPixels.h"
#include "support/Random.h"

namespace hagen {
namespace {

using test::pixelsAt;

Attitude anyAttitude(test::Random& random) {
    const float max_rad = static_cast<float>(radians(15));
    return {random.real(-max_rad, max_rad), random.real(-max_rad, max_rad)};
}

/// Points on a plane `below_m` under the sensor, in 16 rings of 2 to 36 m. The sensor has
/// `attitude` relative to the plane.
std::vector<Eigen::Vector3f> ringsOnPlane(const Attitude& attitude, float below_m) {
    std::vector<Eigen::Vector3f> points;
    const Eigen::Matrix3f sensor_from_plane = levelFromSensor(attitude).transpose();
    for (int ring = 0; ring < 16; ++ring) {
        const float radius_m = 2.0f * std::pow(1.212f, static_cast<float>(ring));
        for (int step = 0; step < 180; ++step) {
            const float azimuth_rad = static_cast<float>(radians(2.0 * step));
            points.push_back(sensor_from_plane * Eigen::Vector3f(radius_m * std::cos(azimuth_rad),
                                                                 radius_m * std::sin(azimuth_rad),
                                                                 -below_m));
        }
    }
    return points;
}

float greatestHeight(const Eigen::Isometry3f& ground_from_sensor,
                     const std::vector<Eigen::Vector3f>& points) {
    float greatest_m = 0;
    for (const Eigen::Vector3f& p : points) {
        greatest_m = std::max(greatest_m, std::abs((ground_from_sensor * p).z()));
    }
    return greatest_m;
}

GroundFrameWorkspace buffers;  // reused, as in a filter

TEST(GroundFrame, PlaneHasZeroHeightAtAnyTilt) {
    test::Random random(70);
    for (int round = 0; round < 20; ++round) {
        const Attitude attitude = anyAttitude(random);
        const float below_m = random.real(0.5f, 10.0f);
        const auto points = ringsOnPlane(attitude, below_m);
        for (const Attitude& start : {Attitude{}, attitude}) {
            const Eigen::Isometry3f frame = fitGroundFrame(pixelsAt(points), start, buffers);
            EXPECT_LT(greatestHeight(frame, points), 0.01f);
            EXPECT_NEAR(frame.translation().z(), below_m, 0.01f);
            EXPECT_NEAR(frame.translation().head<2>().norm(), 0, 1e-5);
            // By the shortest rotation, forward stays forward in top view.
            EXPECT_TRUE((frame.linear() * frame.linear().transpose()).isIdentity(1e-5f));
            EXPECT_GT(frame.linear()(0, 0), 0.9f);
        }
    }
}

TEST(GroundFrame, IgnoresWallsAndCrowns) {
    test::Random random(71);
    for (int round = 0; round < 20; ++round) {
        const Attitude attitude = anyAttitude(random);
        const Eigen::Vector3f normal = levelFromSensor(attitude).transpose().col(2);
        const auto ground = ringsOnPlane(attitude, 3);
        auto points = ground;
        // A wall from 8 m on fills 100 degrees (28 % of the returns) and hides the ground behind.
        const int first = random.whole(0, 179);
        int raised = 0;
        for (std::size_t i = 8 * 180; i < points.size(); ++i) {
            const int step = (static_cast<int>(i % 180) - first + 180) % 180;
            if (step >= 50) continue;
            points[i] += random.real(0, 6) * normal;
            ++raised;
        }
        for (Eigen::Vector3f& p : points) {  // adds tree crowns anywhere
            if (!random.chance(0.2)) continue;
            p += random.real(0.5f, 6) * normal;
            ++raised;
        }
        ASSERT_GT(raised, 0.3 * static_cast<double>(points.size()));
        const Eigen::Isometry3f frame = fitGroundFrame(pixelsAt(points), attitude, buffers);
        for (const Eigen::Vector3f& p : ground) {
            const float height_m = (frame * p).z();
            ASSERT_LT(std::abs(height_m), 0.02f + 0.01f * p.norm());
        }
    }
}

TEST(GroundFrame, IsBelowSensorUnderCrowns) {
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < 4000; ++i) {
        const float x_m = 0.9f * static_cast<float>(i % 63 - 31);
        const float y_m = 0.9f * static_cast<float>(i / 63 - 31);
        const bool is_ground = std::hypot(x_m, y_m) < 5;  // crowns hide the rest
        points.emplace_back(x_m, y_m, is_ground ? -0.3f : 1 + 0.1f * static_cast<float>(i % 50));
    }
    const Eigen::Isometry3f frame = fitGroundFrame(pixelsAt(points), Attitude{}, buffers);
    EXPECT_NEAR(frame.translation().z(), 0.3f, 0.1f);
    EXPECT_GT(frame.linear()(2, 2), 0.99f);
}

TEST(GroundFrame, IgnoresStraysFarAndEmptyPixels) {
    test::Random random(72);
    const auto ground = ringsOnPlane({}, 2);
    auto points = ground;
    for (Eigen::Vector3f& p : points) {
        if (random.chance(0.05)) p.z() -= 3;
    }
    for (int step = 0; step < 100; ++step) {
        points.emplace_back(41, static_cast<float>(step) - 50, -15);
    }
    points.insert(points.end(), 1000, test::kEmptyPixel);
    EXPECT_LT(greatestHeight(fitGroundFrame(pixelsAt(points), Attitude{}, buffers), ground), 0.05f);
}

TEST(GroundFrame, IgnoresCrownsAboveTheLimit) {
    const auto ground = ringsOnPlane({}, 2);
    auto points = ground;
    for (Eigen::Vector3f& p : points) {
        if (p.x() > 0) p.z() += 3;  // no ground is visible there
    }
    const auto errorWith = [&](float max_m) {
        const Eigen::Isometry3f frame =
            fitGroundFrame(pixelsAt(points), Attitude{}, buffers, nullptr, max_m);
        return greatestHeight(frame, ground);
    };
    EXPECT_LT(errorWith(0), 0.05f);
    EXPECT_GT(errorWith(kNoLimit_m), 0.3f);
}

TEST(GroundFrame, WeighsPointsAboveLess) {
    const auto movedBy = [](float off_m) {  // moves every fourth point, one per cell
        auto points = test::groundPoints(36, 1.5f, [](float, float) { return -2.0f; });
        for (std::size_t i = 0; i < points.size(); i += 4) points[i].z() += off_m;
        const PixelPoints pixels = pixelsAt(points, 49);  // points per side of the square
        return std::abs(fitGroundFrame(pixels, Attitude{}, buffers).translation().z() - 2);
    };
    EXPECT_GT(movedBy(0.5f), 0.001f);
    EXPECT_LT(movedBy(0.5f), 0.8f * movedBy(-0.5f));
}

TEST(GroundFrame, TwoCellsYieldLevelPlane) {
    const Eigen::Isometry3f frame =
        fitGroundFrame(pixelsAt({{5, 0, -1.5f}, {8, 3, -2}}), {}, buffers);
    EXPECT_TRUE(frame.linear().isIdentity());
    EXPECT_FLOAT_EQ(frame.translation().z(), 2);
    EXPECT_FLOAT_EQ(fitGroundFrame(pixelsAt({{5, 0, -1.5f}}), {}, buffers).translation().z(), 1.5f);
}

TEST(GroundFrame, NoPixelYieldsLevelPlaneThroughSensor) {
    const PixelPoints none = pixelsAt({test::kEmptyPixel, test::kEmptyPixel});
    EXPECT_TRUE(fitGroundFrame(none, {}, buffers).isApprox(Eigen::Isometry3f::Identity()));
    const Attitude attitude{0.1f, 0.2f};
    EXPECT_TRUE(
        fitGroundFrame(none, attitude, buffers).linear().isApprox(levelFromSensor(attitude)));
    EXPECT_TRUE(fitGroundFrame(none, attitude, buffers).translation().isZero());
}

TEST(GroundFrame, AcceptsCollinearPoints) {
    std::vector<Eigen::Vector3f> line;
    for (int i = 1; i < 20; ++i) line.emplace_back(static_cast<float>(i), 0, -2);
    const Eigen::Isometry3f frame = fitGroundFrame(pixelsAt(line), {}, buffers);
    EXPECT_TRUE(frame.matrix().allFinite());
    EXPECT_LT(greatestHeight(frame, line), 0.01f);
}

TEST(CanBeGround, NeedsSensorAboveLevelGround) {
    const auto frameAt = [](float height_m, double tilt_deg) {
        Eigen::Isometry3f frame = Eigen::Isometry3f::Identity();
        frame.linear() = levelFromSensor({static_cast<float>(radians(tilt_deg)), 0});
        frame.translation().z() = height_m;
        return frame;
    };
    Image<Label> labels = Image<Label>::Constant(16, 10, Label::Roi);
    labels.leftCols(4) = Label::Rou;  // 64 pixels
    EXPECT_TRUE(canBeGround(frameAt(2, 0), {}, labels));
    EXPECT_TRUE(canBeGround(frameAt(2, 44), {}, labels));
    EXPECT_TRUE(canBeGround(frameAt(2, -44), {}, labels));
    EXPECT_FALSE(canBeGround(frameAt(2, 46), {}, labels));
    // The sensor has a known mount of 60 degrees.
    const Attitude mounted{static_cast<float>(radians(60)), 0};
    EXPECT_TRUE(canBeGround(frameAt(2, 60), mounted, labels));
    EXPECT_FALSE(canBeGround(frameAt(2, 0), mounted, labels));
    EXPECT_TRUE(canBeGround(frameAt(-0.29f, 0), {}, labels));
    EXPECT_FALSE(canBeGround(frameAt(-0.31f, 0), {}, labels));
    EXPECT_FALSE(canBeGround(frameAt(-2, 0), {}, labels));
    labels.leftCols(3) = Label::Roi;
    EXPECT_FALSE(canBeGround(frameAt(2, 0), {}, labels));  // 16 pixels
    labels.col(9).head(4) = Label::Rou;
    EXPECT_TRUE(canBeGround(frameAt(2, 0), {}, labels));  // 20
    labels(0, 9) = Label::Roi;
    EXPECT_FALSE(canBeGround(frameAt(2, 0), {}, labels));
}

TEST(Upwards, WithoutAttitudeIsGroundNormal) {
    const Eigen::Isometry3f frame =
        fitGroundFrame(pixelsAt(ringsOnPlane({0.2f, 0.1f}, 2)), {}, buffers);
    EXPECT_EQ(upwards(frame, std::nullopt), Eigen::Vector3f::UnitZ());
}

TEST(Upwards, SlopeLeansFromNormal) {
    // A level sensor over ground that rises ahead by 10 degrees is pitched down relative to the
    // ground, so up leans forward from the ground normal.
    const Attitude against_slope{0, static_cast<float>(radians(10))};
    const Eigen::Isometry3f frame =
        fitGroundFrame(pixelsAt(ringsOnPlane(against_slope, 2)), Attitude{}, buffers);
    const Eigen::Vector3f up = upwards(frame, Attitude{});
    EXPECT_NEAR(up.z(), std::cos(radians(10)), 1e-3);
    EXPECT_NEAR(up.x(), std::sin(radians(10)), 1e-3);
    EXPECT_NEAR(up.norm(), 1, 1e-5);
}

}  // namespace
}  // namespace hagen
