#include <gtest/gtest.h>
#include <hagen/trials/TrialSensor.h>

#include <algorithm>

#include "trials/SimpleCourse.h"

namespace hagen::trials {
namespace {

using test::emptyContent;
using test::putWall;
using test::simpleCourse;

/// A second of flight at 8 m/s along x while it brakes hard, so that the body is tilted.
FlightTrace fastTrace() {
    avoidance::VehicleState state{{0, 0, 2}, {8, 0, 0}};
    FlightTrace trace(state);
    for (int step = 0; step < 50; ++step) {
        state.position_m += avoidance::kControlStep_s * state.velocity_m_s;
        state.velocity_m_s.x() -= 5 * avoidance::kControlStep_s;
        trace.add(state, {-5, 0, 0});
    }
    return trace;
}

/// Share of the returns at a man's height that lie on the wall's near face.
double shareOnWall(const mapping::MappedScan& scan, const Eigen::Vector3d& offset_m,
                   double tolerance_m) {
    double on = 0, all = 0;
    for (const Eigen::Vector3f& point : scan.points_m) {
        const Eigen::Vector3d at = point.cast<double>() - offset_m;
        if (at.z() < 0.6 || at.x() < 5 || std::abs(at.y()) > 8) continue;
        ++all;
        if (std::abs(at.x() - 10) < tolerance_m) ++on;
    }
    EXPECT_GT(all, 500);
    return on / all;
}

TEST(TrialSensor, ReturnsComeToLieWhereTheyWereMeasuredInFlight) {
    simulation::SceneContent content = emptyContent();
    putWall(content, -10, 10);
    const Course course = simpleCourse(std::move(content));
    const FlightTrace trace = fastTrace();
    TrialSensor sensor(course);
    for (const PoseError error : {PoseError::None, PoseError::Drift}) {
        PoseBelief belief(error, 3);
        const simulation::SimulatedScan measured = sensor.measure(7, trace);
        const auto labels = sensor.segment(7, measured, trace, belief);
        const mapping::MappedScan scan = sensor.place(7, measured, labels, trace, belief);
        EXPECT_NEAR(scan.time_s, 0.8, 1e-9);
        const Eigen::Vector3d offset = belief.offset_m(trace, 0.75);
        EXPECT_NEAR((scan.origin_m.cast<double>() - trace.at(0.75).position_m - offset).norm(), 0,
                    1e-4);
        EXPECT_GT(shareOnWall(scan, offset, 0.08), 0.98);  // 4 sigma; it moved 0.5 m meanwhile
    }
}

TEST(TrialSensor, AWallIsOfInterestAndTheGroundIsNot) {
    simulation::SceneContent content = emptyContent();
    putWall(content, -10, 10);
    const Course course = simpleCourse(std::move(content));
    const FlightTrace trace = fastTrace();
    TrialSensor sensor(course);
    PoseBelief belief(PoseError::None, 3);
    const simulation::SimulatedScan measured = sensor.measure(5, trace);
    const std::vector<Label> labels = sensor.segment(5, measured, trace, belief).label;
    int right = 0, all = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] == Label::Unclassified || measured.scan.range_m[i] > 19) continue;
        ++all;
        right += (labels[i] == Label::Roi) == (measured.kind[i] == simulation::ObjectClass::Wall)
                     ? 1
                     : 0;
    }
    EXPECT_GT(all, 3000);
    EXPECT_GT(right, 0.95 * all);
}

TEST(TrialSensor, ATurnDoesNotDependOnThoseAskedForBefore) {
    simulation::SceneContent content = emptyContent();
    putWall(content, -10, 10);
    const Course course = simpleCourse(std::move(content));
    const FlightTrace trace = fastTrace();
    const TrialSensor one(course), other(course);
    one.measure(2, trace);
    const simulation::SimulatedScan a = one.measure(6, trace), b = other.measure(6, trace);
    EXPECT_EQ(a.scan.range_m, b.scan.range_m);
    EXPECT_NE(a.scan.range_m, other.measure(7, trace).scan.range_m);
}

}  // namespace
}  // namespace hagen::trials
