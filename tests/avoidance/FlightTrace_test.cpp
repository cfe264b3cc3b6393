#include "avoidance/flights/FlightTrace.h"
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>
#include "avoidance/flights/PoseBelief.h"

namespace hagen::avoidance {
namespace {

/// Accelerates along x from rest for one second.
FlightTrace accelerating(double acceleration_m_s2) {
    VehicleState state;
    FlightTrace trace(state);
    for (int step = 1; step <= 50; ++step) {
        const double time_s = step * kControlStep_s;
        state.position_m.x() = 0.5 * acceleration_m_s2 * time_s * time_s;
        state.velocity_m_s.x() = acceleration_m_s2 * time_s;
        trace.add(state, {acceleration_m_s2, 0, 0});
    }
    return trace;
}

TEST(FlightTrace, LeansIntoAcceleration) {
    const FlightTrace trace = accelerating(9.81);
    EXPECT_NEAR((trace.at(0).attitude.toRotationMatrix() - Eigen::Matrix3d::Identity()).norm(), 0,
                1e-12);
    const Eigen::Matrix3d attitude = trace.at(1).attitude.toRotationMatrix();
    EXPECT_NEAR(std::atan2(attitude(0, 2), attitude(2, 2)), radians(45), 1e-3);  // tilts forwards
    EXPECT_NEAR(attitude(1, 0), 0, 1e-12);  // heading stays along x
}

TEST(FlightTrace, InterpolatesBetweenSamples) {
    const FlightTrace trace = accelerating(2);
    EXPECT_NEAR(trace.at(0.51).position_m.x(), 0.5 * (0.25 + 0.2704), 1e-9);
    EXPECT_EQ(trace.at(7).position_m, trace.at(1).position_m);
    EXPECT_EQ(trace.at(-1).position_m, Eigen::Vector3d::Zero());
    EXPECT_NEAR(trace.distance_m(1), 1, 1e-9);
}

TEST(FlightTrace, JerkMatchesSmoothedAcceleration) {
    EXPECT_EQ(FlightTrace(VehicleState{}).rmsJerk_m_s3(), 0);
    // The squared jerk of the smoothed step, 3 (1 - exp(-t / 0.1 s)), integrates to 9 / 0.2.
    EXPECT_NEAR(accelerating(3).rmsJerk_m_s3(), std::sqrt(9 / 0.2), 0.3);
}

TEST(PoseBelief, EqualsTruthWithoutError) {
    const FlightTrace trace = accelerating(2);
    PoseBelief belief(PoseError::None, 1);
    EXPECT_EQ(belief.at(trace, 0.33).position_m, trace.at(0.33).position_m);
    EXPECT_EQ(belief.at(trace, 0.33).attitude.coeffs(), trace.at(0.33).attitude.coeffs());
}

TEST(PoseBelief, DriftGrowsWithDistance) {
    const FlightTrace trace = accelerating(20);  // 10 m
    PoseBelief belief(PoseError::Drift, 1);
    EXPECT_NEAR(belief.offset_m(trace, 1).norm(), 0.1, 1e-9);
    EXPECT_NEAR((belief.offset_m(trace, 1) / trace.distance_m(1) -
                 belief.offset_m(trace, 0.5) / trace.distance_m(0.5))
                    .norm(),
                0, 1e-12);
}

TEST(PoseBelief, NoiseMatchesStandardDeviation) {
    const FlightTrace trace(VehicleState{});
    PoseBelief belief(PoseError::Noise, 5), late(PoseError::Noise, 5), other(PoseError::Noise, 6);
    const Eigen::Vector3d last = late.offset_m(trace, 99);  // queried out of order
    double squares_m2 = 0, squares_rad2 = 0;
    const int knots = 1000;
    for (int knot = 0; knot < knots; ++knot) {
        const simulation::SensorPose pose = belief.at(trace, 0.1 * knot);
        squares_m2 += pose.position_m.squaredNorm() / 3 / knots;
        const double angle = Eigen::AngleAxisd(pose.attitude).angle();
        squares_rad2 += angle * angle / 3 / knots;
    }
    EXPECT_NEAR(std::sqrt(squares_m2), 0.05, 0.003);
    EXPECT_NEAR(degrees(std::sqrt(squares_rad2)), 0.5, 0.03);
    EXPECT_EQ(belief.offset_m(trace, 99), last);
    EXPECT_NE(other.offset_m(trace, 99), last);
    EXPECT_LT((belief.offset_m(trace, 50.001) - belief.offset_m(trace, 50)).norm(), 0.01);
}

}  // namespace
}  // namespace hagen::avoidance
