// A LiDAR labelled during each turn, compared with TrialSensor, beam directions and the scene.
#include "avoidance/flights/SectorSensor.h"
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>

#include <cmath>

#include "avoidance/SimpleCourse.h"

namespace hagen::avoidance {
namespace {

using test::emptyContent;
using test::putWall;
using test::simpleCourse;

constexpr double kStep_s = kControlStep_s;
constexpr double kMaxSector_s = 0.1 * 15 / 360;

/// A flight along x that turns sideways at 0.25 s.
FlightTrace traceUntil(int steps, double speed_m_s = 8) {
    VehicleState state{{0, 0, 2}, {speed_m_s, 0, 0}};
    FlightTrace trace(state);
    for (int step = 0; step < steps; ++step) {
        const Eigen::Vector3d push(0, kStep_s * step < 0.25 ? 0 : 5, 0);
        state.position_m += kStep_s * state.velocity_m_s;
        state.velocity_m_s += kStep_s * push;
        trace.add(state, push);
    }
    return trace;
}

Course courseWithWall() {
    simulation::SceneContent content = emptyContent();
    putWall(content, -10, 10);
    return simpleCourse(std::move(content));
}

/// The sectors of a flight, read at each control step.
std::vector<observations::MappedScan> sectorsOf(const Course& course, Air air, PoseError error,
                                                int steps) {
    SectorSensor sensor(course, air);
    PoseBelief belief(error, 3);
    std::vector<observations::MappedScan> sectors;
    for (int step = 1; step <= steps; ++step) {
        // The sensor gets only the trace flown so far.
        for (auto& sector : sensor.measureUntil(kStep_s * step, traceUntil(step), belief)) {
            sectors.push_back(std::move(sector));
        }
    }
    return sectors;
}

TEST(SectorSensor, SectorsEndWithLastPacket) {
    const auto sectors = sectorsOf(courseWithWall(), Air::Clear, PoseError::None, 15);
    ASSERT_GT(sectors.size(), 70u);
    double last_s = 0, turns = 0;
    for (const observations::MappedScan& sector : sectors) {
        EXPECT_LE(sector.turns, 15.0 / 360 + 1e-9);
        EXPECT_GT(sector.time_s, last_s);
        turns += sector.turns;
        // Sectors follow each other without gaps.
        EXPECT_NEAR(sector.time_s, 0.1 * turns, 1e-4);
        for (const float age_s : sector.age_s) {
            ASSERT_GE(age_s, -4e-5f);  // a turn lasts a little longer than 0.1 s
            ASSERT_LE(age_s, kMaxSector_s + 1e-4);
        }
        last_s = sector.time_s;
    }
    EXPECT_NEAR(last_s, 0.3, kMaxSector_s);
}

/// Simulating parts of a turn is tested with the simulation: EachSensor.PartsEqualWholeTurn.
TEST(SectorSensor, ReturnsMatchWholeScans) {
    const Course course = courseWithWall();
    const TrialSensor whole(course, Air::Dusty);
    const FlightTrace trace = traceUntil(20);
    for (const PoseError error : {PoseError::None, PoseError::Noise, PoseError::Drift}) {
        PoseBelief belief(error, 3);
        std::vector<Eigen::Vector3f> expected;
        for (int turn = 0; turn < 3; ++turn) {
            int first = 0;
            for (const int ms : {20, 40, 60, 80, 100}) {
                // Packets contain 24 firings of 55.296 us; the last packet has the remainder.
                const int end = ms == 100 ? 1809 : static_cast<int>(ms / (24 * 0.055296)) * 24;
                const auto measured = whole.measureFirings(turn, {first, end}, trace);
                LabelledReturns labelled;
                for (const float range_m : measured.scan.range_m) {
                    labelled.label.push_back(std::isnan(range_m) ? Label::Unclassified
                                                                 : Label::Roi);
                    labelled.component.push_back(0);
                }
                const auto placed = TrialSensor::place(turn, measured, labelled, trace, belief);
                expected.insert(expected.end(), placed.points_m.begin(), placed.points_m.end());
                first = end;
            }
        }
        std::vector<Eigen::Vector3f> found;
        for (const auto& sector : sectorsOf(course, Air::Dusty, error, 16)) {
            found.insert(found.end(), sector.points_m.begin(), sector.points_m.end());
        }
        ASSERT_GT(expected.size(), 40000u);
        ASSERT_GT(found.size(), expected.size());  // includes returns of the fourth turn
        for (std::size_t i = 0; i < expected.size(); ++i) {
            ASSERT_LT((found[i] - expected[i]).norm(), 1e-4f) << nameOf(error) << " " << i;
        }
    }
}

TEST(SectorSensor, LabelsMatchGround) {
    const Course course = courseWithWall();
    int right = 0, all = 0;
    double turns = 0;
    for (const auto& sector : sectorsOf(course, Air::Clear, PoseError::None, 15)) {
        turns += sector.turns;
        for (std::size_t i = 0; i < sector.points_m.size(); ++i) {
            const Eigen::Vector3f at = sector.points_m[i];
            if ((at - sector.origin_m).norm() > 19) continue;
            if (turns < 0.5) {  // too few returns to find the ground
                ASSERT_EQ(sector.labels[i], Label::Roi);
                continue;
            }
            ++all;
            right += (sector.labels[i] == Label::Roi) == (at.x() > 9.8f && at.z() > 0.1f);
        }
    }
    EXPECT_GT(all, 30000);
    EXPECT_GT(right, 0.97 * all);
}

/// Time at which the model contains an obstacle at a point.
double knownAt_s(const std::string& name, bool by_sectors, const Eigen::Vector3f& point_m) {
    const Course course = courseWithWall();
    WorldModelSetting setting;
    setting.bounds_m = course.bounds_m.cast<float>();
    const auto model = makeWorldModel(name, setting);
    const FlightTrace trace = traceUntil(20, 0);  // hovers
    PoseBelief belief(PoseError::None, 3);
    SectorSensor sectors(course, Air::Clear);
    TrialSensor scans(course, Air::Clear);
    for (int ms = 1; ms <= 200; ++ms) {
        if (by_sectors) {
            for (const auto& sector : sectors.measureUntil(1e-3 * ms, trace, belief)) {
                model->update(sector);
            }
        } else if (ms % 100 == 0) {
            const auto measured = scans.measure(ms / 100 - 1, trace);
            const auto& labels = scans.segment(ms / 100 - 1, measured, trace, belief);
            model->update(TrialSensor::place(ms / 100 - 1, measured, labels, trace, belief));
        }
        // A voxel of 0.4 m plus the model's bias.
        if (model->clearance_m(point_m) < 0.5f) return 1e-3 * ms;
    }
    return 1;
}

TEST(SectorSensor, WallReachesModelWithinSector) {
    for (const char* model : {"W-RoI", "W-Full", "R-Full-0.2", "O-Full-0.4"}) {
        for (const float y_m : {-3.0f, 3.0f}) {
            const Eigen::Vector3f on_wall(10, y_m, 2);
            // A turn starts behind the vehicle and proceeds clockwise.
            const double clockwise_rad = kPi - std::atan2(static_cast<double>(y_m), 10.0);
            const double seen_s = 0.1 * clockwise_rad / (2 * kPi);
            const double known_s = knownAt_s(model, true, on_wall);
            EXPECT_GT(known_s, seen_s - 0.001) << model << " " << y_m;
            // A sector, the preceding packet, and the test's resolution of 1 ms.
            EXPECT_LT(known_s, seen_s + kMaxSector_s + 0.0014 + 0.001) << model << " " << y_m;
        }
        EXPECT_NEAR(knownAt_s(model, false, {10, 0, 2}), 0.1, 1e-9) << model;
    }
}

TEST(SectorSensor, JoinedSectorsKeepReturnsAndAges) {
    const auto sectors = sectorsOf(courseWithWall(), Air::Dusty, PoseError::None, 10);
    const observations::MappedScan all = joined(sectors);
    std::size_t at = 0;
    double turns = 0;
    for (const auto& sector : sectors) {
        turns += sector.turns;
        for (std::size_t i = 0; i < sector.points_m.size(); ++i, ++at) {
            ASSERT_EQ(all.points_m[at], sector.points_m[i]);
            ASSERT_EQ(all.labels[at], sector.labels[i]);
            ASSERT_NEAR(all.time_s - static_cast<double>(all.age_s[at]),
                        sector.time_s - static_cast<double>(sector.age_s[i]), 1e-6);
        }
    }
    EXPECT_EQ(at, all.points_m.size());
    EXPECT_EQ(all.age_s.size(), all.points_m.size());
    EXPECT_NEAR(all.turns, turns, 1e-12);
    EXPECT_EQ(all.time_s, sectors.back().time_s);
    // The mean position at 8 m/s along x is halfway.
    EXPECT_NEAR(all.origin_m.x(), 8 * 0.5 * all.time_s, 0.02);
}

}  // namespace
}  // namespace hagen::avoidance
