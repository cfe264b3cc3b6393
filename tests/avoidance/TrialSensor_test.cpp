#include "avoidance/flights/TrialSensor.h"
#include <gtest/gtest.h>
#include <hagen/settings/Settings.h>

#include <algorithm>
#include <cmath>

#include "avoidance/SimpleCourse.h"

namespace hagen::avoidance {
namespace {

using test::emptyContent;
using test::putWall;
using test::simpleCourse;

/// One second of flight at 8 m/s along x with hard braking, which tilts the body.
FlightTrace fastTrace() {
    VehicleState state{{0, 0, 2}, {8, 0, 0}};
    FlightTrace trace(state);
    for (int step = 0; step < 50; ++step) {
        state.position_m += kControlStep_s * state.velocity_m_s;
        state.velocity_m_s.x() -= 5 * kControlStep_s;
        trace.add(state, {-5, 0, 0});
    }
    return trace;
}

/// Share of the returns at head height that lie on the wall's near face.
double shareOnWall(const observations::MappedScan& scan, const Eigen::Vector3d& offset_m,
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

TEST(TrialSensor, PlacesReturnsDuringFlight) {
    simulation::SceneContent content = emptyContent();
    putWall(content, -10, 10);
    const Course course = simpleCourse(std::move(content));
    const FlightTrace trace = fastTrace();
    TrialSensor sensor(course, Air::Clear);
    for (const PoseError error : {PoseError::None, PoseError::Drift}) {
        PoseBelief belief(error, 3);
        const simulation::SimulatedScan measured = sensor.measure(7, trace);
        const auto labels = sensor.segment(7, measured, trace, belief);
        const observations::MappedScan scan = sensor.place(7, measured, labels, trace, belief);
        EXPECT_NEAR(scan.time_s, 0.8, 1e-9);
        const Eigen::Vector3d offset = belief.offset_m(trace, 0.75);
        EXPECT_NEAR((scan.origin_m.cast<double>() - trace.at(0.75).position_m - offset).norm(), 0,
                    1e-4);
        EXPECT_GT(shareOnWall(scan, offset, 0.08), 0.98);  // 4 sigma; the vehicle moved 0.5 m
    }
}

TEST(TrialSensor, SeesWholeZone) {
    simulation::SceneContent content = emptyContent();
    putWall(content, -40, 40);
    const Course course = simpleCourse(std::move(content));
    const FlightTrace trace = fastTrace();
    for (const float zone_m : {20.0f, 27.5f}) {
        TrialSensor sensor(course, Air::Clear, zone_m);
        PoseBelief belief(PoseError::None, 3);
        const simulation::SimulatedScan measured = sensor.measure(5, trace);
        const std::vector<Label> labels = sensor.segment(5, measured, trace, belief).label;
        int roi = 0, all = 0;
        for (std::size_t i = 0; i < labels.size(); ++i) {
            const bool is_between =
                measured.scan.range_m[i] > 20.1f && measured.scan.range_m[i] < 27;
            if (!is_between || measured.kind[i] != simulation::ObjectClass::Wall) continue;
            ++all;
            if (labels[i] == Label::Roi) ++roi;
        }
        EXPECT_GT(all, 400);
        if (zone_m > 20) {
            EXPECT_GT(roi, 0.95 * all);
        } else {
            EXPECT_EQ(roi, 0);
        }
    }
}

/// Number of returns of this class that still have a range.
int countOf(simulation::ObjectClass kind, const simulation::SimulatedScan& measured) {
    int count = 0;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        if (measured.kind[i] == kind && !std::isnan(measured.scan.range_m[i])) ++count;
    }
    return count;
}

TEST(TrialSensor, DustyAirAddsOnlyDust) {
    simulation::SceneContent content = emptyContent();
    putWall(content, -10, 10);
    const Course course = simpleCourse(std::move(content));
    const FlightTrace trace = fastTrace();
    TrialSensor dusty(course, Air::Dusty);
    const TrialSensor clear(course, Air::Clear);
    PoseBelief belief(PoseError::None, 3);
    int specks = 0;
    for (int turn = 0; turn < 10; ++turn) {
        const simulation::SimulatedScan in_clear_air = clear.measure(turn, trace);
        EXPECT_EQ(countOf(simulation::ObjectClass::Dust, in_clear_air), 0);
        const simulation::SimulatedScan measured = dusty.measure(turn, trace);
        EXPECT_EQ(countOf(simulation::ObjectClass::Airframe, measured), 0);
        specks += countOf(simulation::ObjectClass::Dust, measured);
        EXPECT_GT(std::count(measured.kind.begin(), measured.kind.end(),
                             simulation::ObjectClass::Airframe),
                  50);
        // The legs hide a few per cent of the wall, the mask hides almost nothing.
        EXPECT_GT(countOf(simulation::ObjectClass::Wall, measured),
                  0.95 * countOf(simulation::ObjectClass::Wall, in_clear_air));
        const auto labels = dusty.segment(turn, measured, trace, belief);
        for (const Eigen::Vector3f& point :
             dusty.place(turn, measured, labels, trace, belief).points_m) {
            const double range_m =
                (point.cast<double>() - trace.at(0.1 * turn + 0.05).position_m).norm();
            ASSERT_GT(range_m, 0.5);
        }
    }
    EXPECT_GT(specks, 10);
}

TEST(TrialSensor, AirframeMatchesSettingsFile) {
    Settings settings;
    mergeSettings(HAGEN_SOURCE_DIR "/config/airframe_simulated.yaml", settings);
    const Airframe &file = settings.airframe.parts, built_in = trialAirframe(Air::Dusty);
    ASSERT_EQ(built_in.boxes.size(), file.boxes.size());
    for (std::size_t i = 0; i < file.boxes.size(); ++i) {
        EXPECT_EQ(built_in.boxes[i].low_m, file.boxes[i].low_m);
        EXPECT_EQ(built_in.boxes[i].high_m, file.boxes[i].high_m);
    }
    ASSERT_EQ(built_in.spheres.size(), file.spheres.size());
    for (std::size_t i = 0; i < file.spheres.size(); ++i) {
        EXPECT_EQ(built_in.spheres[i].centre_m, file.spheres[i].centre_m);
        EXPECT_EQ(built_in.spheres[i].radius_m, file.spheres[i].radius_m);
    }
    EXPECT_TRUE(trialAirframe(Air::Clear).isEmpty());
}

TEST(TrialSensor, TurnsAreIndependent) {
    simulation::SceneContent content = emptyContent();
    putWall(content, -10, 10);
    const Course course = simpleCourse(std::move(content));
    const FlightTrace trace = fastTrace();
    const TrialSensor one(course, Air::Dusty), other(course, Air::Dusty);
    one.measure(2, trace);
    const simulation::SimulatedScan a = one.measure(6, trace), b = other.measure(6, trace);
    EXPECT_EQ(a.scan.x_m, b.scan.x_m);
    EXPECT_NE(a.scan.x_m, other.measure(7, trace).scan.x_m);
}

}  // namespace
}  // namespace hagen::avoidance
