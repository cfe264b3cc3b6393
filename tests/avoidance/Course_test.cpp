#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/avoidance/Course.h>
#include <hagen/avoidance/TrialSensor.h>
#include <hagen/scan/Angle.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <stdexcept>
#include <utility>

namespace hagen::avoidance {
namespace {

using testing::HasSubstr;

using Eigen::Vector3d;
using Eigen::Vector3f;

/// Made once; courses are costly.
const Course& course(const std::string& name, std::uint64_t seed) {
    static std::map<std::pair<std::string, std::uint64_t>, Course> made;
    const auto key = std::make_pair(name, seed);
    const auto known = made.find(key);
    return known != made.end() ? known->second
                               : made.emplace(key, makeCourse(name, seed)).first->second;
}

Vector3f above(const Course& course, double x_m, double y_m, double height_m) {
    return Vector3d(x_m, y_m, course.scene.terrain().height_m(x_m, y_m) + height_m).cast<float>();
}

/// The least clearance on the straight way, at the altitude wanted, with what stands.
float leastClearanceStraight_m(const Course& course) {
    float least_m = 1e9f;
    for (double x_m = course.start_m.x(); x_m <= course.goal_m.x(); x_m += 0.05) {
        least_m =
            std::min(least_m, course.distance.toStatic(above(course, x_m, 0, course.altitude_m)));
    }
    return least_m;
}

int count(const Course& course, simulation::ObjectClass kind) {
    const auto& objects = course.scene.content().objects;
    return static_cast<int>(
        std::count_if(objects.begin(), objects.end(),
                      [&](const simulation::SceneObject& o) { return o.kind == kind; }));
}

simulation::SimulatedScan scanAtStart(const Course& course, double time_s = 0) {
    const simulation::PoseAt pose_at = [&](double) {
        return simulation::SensorPose{course.start_m, Eigen::Quaterniond::Identity()};
    };
    simulation::Random random(1);
    return simulation::simulateScan(course.scene, sensorModel("VLP-16"), pose_at, time_s, random,
                                    trialErrorModel(Air::Clear));
}

/// The nearest that stands on the ground or moves, by rays in all directions.
double nearestThing_m(const Course& course, const Vector3f& from, double time_s) {
    std::vector<simulation::Ray> rays;
    simulation::Random random(3);
    for (int i = 0; i < 4000; ++i) {
        const double a = random.normal(), b = random.normal(), d = random.normal();
        rays.push_back({from, Vector3d(a, b, d).normalized().cast<float>(), 0});
    }
    std::vector<simulation::RayHit> hits;
    course.scene.snapshotOver(time_s, 1e-6).cast(rays, 100, hits);
    double nearest_m = 100;
    for (const simulation::RayHit& hit : hits) {
        if (simulation::labelOf(hit.kind) != Label::Roi) continue;
        nearest_m = std::min(nearest_m, static_cast<double>(hit.range_m));
    }
    return nearest_m;
}

class EachCourse : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, EachCourse, testing::ValuesIn(courseNames()), [](const auto& tested) {
    std::string name = tested.param;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '-' || c == '.'; }, '_');
    return name;
});

TEST_P(EachCourse, LeadsFortyMetresThroughItsBoundsFromAFreePlaceToAnother) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Course& c = course(GetParam(), seed);
        EXPECT_EQ(c.scenario, GetParam());
        EXPECT_EQ(c.seed, seed);
        EXPECT_NEAR((c.goal_m - c.start_m).head<2>().norm(), 40, 1e-9);
        EXPECT_TRUE(c.bounds_m.contains(c.start_m) && c.bounds_m.contains(c.goal_m));
        for (const Vector3d& end : {c.start_m, c.goal_m}) {
            const double ground_m = c.scene.terrain().height_m(end.x(), end.y());
            EXPECT_NEAR(end.z() - ground_m, c.altitude_m, 1e-9);
            for (double time_s = 0; time_s < 30; time_s += 3) {
                EXPECT_GT(nearestThing_m(c, end.cast<float>(), time_s), 2.0) << "seed " << seed;
            }
        }
    }
}

TEST_P(EachCourse, HasAPathThatIsNoShorterThanTheStraightWayAndNotMuchLonger) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Course& c = course(GetParam(), seed);
        const double straight_m = (c.goal_m - c.start_m).norm();
        EXPECT_GE(c.oracle_path_m, straight_m - 1e-9);
        EXPECT_LE(c.oracle_path_m, 1.35 * straight_m) << "seed " << seed;
    }
}

TEST_P(EachCourse, IsTheSameForTheSameSeedAndAnotherForAnother) {
    const Course& first = course(GetParam(), 1);
    const Course again = makeCourse(GetParam(), 1);
    const simulation::SimulatedScan scan = scanAtStart(first), same = scanAtStart(again);
    EXPECT_EQ(scan.scan.x_m, same.scan.x_m);
    EXPECT_EQ(scan.scan.range_m, same.scan.range_m);
    EXPECT_EQ(scan.object, same.object);
    EXPECT_EQ(first.oracle_path_m, again.oracle_path_m);
    EXPECT_NE(scan.scan.range_m, scanAtStart(course(GetParam(), 2)).scan.range_m);
    EXPECT_GT(scan.size(), 8000u);
}

TEST(CourseTest, TrueDistancesAreAboutThoseOfRaysInAllDirections) {
    for (const char* name : {"forest-0.10", "street", "movers"}) {
        const Course& c = course(name, 1);
        for (double x_m = 2; x_m < 38; x_m += 2) {
            const Vector3f at = above(c, x_m, 0, 2.9);  // farther from the ground than what counts
            const double nearest_m = nearestThing_m(c, at, 0);
            const auto distance_m = static_cast<double>(c.distance.at(at, 0));
            EXPECT_LE(distance_m, nearest_m + 1e-3) << name << " at " << x_m;
            if (nearest_m < 2.2) {
                EXPECT_NEAR(distance_m, nearest_m, 0.3) << name << " at " << x_m;
            }
        }
    }
}

TEST(CourseTest, AForestHasAsManyTreesAsItsDensitySays) {
    for (const auto& [name, per_m2] :
         std::map<std::string, double>{{"forest-0.02", 0.02}, {"forest-0.10", 0.10}}) {
        const double expected = per_m2 * 56 * 34;  // less those at the ends: 3.9 m about each
        double mean = 0;
        for (std::uint64_t seed = 1; seed <= 3; ++seed)
            mean += count(course(name, seed), simulation::ObjectClass::Tree) / 3.0;
        EXPECT_NEAR(mean, expected - per_m2 * 2 * kPi * 3.9 * 3.9, 2.5 * std::sqrt(expected / 3))
            << name;
    }
}

/// The clearance of the tightest place on the widest way from one side of a rectangle to the other,
/// along x, 2 m above the ground: the widest of all ways, by Dijkstra over cells of 0.1 m.
double widestWay_m(const Course& c, double from_x_m, double to_x_m) {
    constexpr double kCell_m = 0.1, kHalfWidth_m = 15;
    const int columns = static_cast<int>((to_x_m - from_x_m) / kCell_m);
    const int rows = static_cast<int>(2 * kHalfWidth_m / kCell_m);
    std::vector<double> width_m(static_cast<std::size_t>(columns * rows), -1);
    std::priority_queue<std::pair<double, int>> open;
    const auto reach = [&](double so_far_m, int column, int row) {
        if (column < 0 || column >= columns || row < 0 || row >= rows) return;
        const int cell = column * rows + row;
        if (width_m[cell] >= 0) return;
        const double here_m = static_cast<double>(c.distance.toStatic(
            above(c, from_x_m + column * kCell_m, row * kCell_m - kHalfWidth_m, 2.0)));
        width_m[cell] = std::min(so_far_m, here_m);
        open.emplace(width_m[cell], cell);
    };
    for (int row = 0; row < rows; ++row) reach(1e9, 0, row);
    while (!open.empty()) {
        const auto [so_far_m, cell] = open.top();
        open.pop();
        const int column = cell / rows, row = cell % rows;
        if (column == columns - 1) return so_far_m;
        for (const int step : {-1, 1}) {
            reach(so_far_m, column + step, row);
            reach(so_far_m, column, row + step);
        }
    }
    return 0;
}

TEST(CourseTest, TheWallHasOneGapOfTheWidthThatItIsSaidToHave) {
    std::vector<double> widths_m;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        widths_m.push_back(2 * widestWay_m(course("gap", seed), 8, 32));
        EXPECT_GT(widths_m.back(), 1.6 - 0.15) << "seed " << seed;  // between cells
        EXPECT_LT(widths_m.back(), 2.4 + 0.01) << "seed " << seed;
    }
    EXPECT_NE(widths_m[0], widths_m[1]);
}

TEST(CourseTest, TheTrapIsInTheWayAndCannotBeFlownOver) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Course& c = course("u-trap", seed);
        for (const double height_m : {1.0, 2.0, 4.5}) {
            float least_m = 9;
            for (double x_m = 15; x_m < 32; x_m += 0.05) {
                least_m = std::min(least_m, c.distance.toStatic(above(c, x_m, 0, height_m)));
            }
            EXPECT_LT(least_m, 0.05f) << "seed " << seed << ", " << height_m << " m";
        }
        EXPECT_GT(c.oracle_path_m, 40.5);
    }
}

/// How wide the wires are that a fence of rays, up from below the straight way, meets [m].
std::vector<double> wireWidths_m(const Course& c) {
    constexpr double kStep_m = 0.001;
    std::vector<simulation::RayHit> hits;
    std::vector<simulation::Ray> rays;
    for (double x_m = 2; x_m < 40; x_m += kStep_m) {
        rays.push_back({above(c, x_m, 0, 1.2), Vector3f::UnitZ(), 0, 2.0f});
    }
    c.scene.snapshotOver(0, 0.1).cast(rays, 2.0f, hits);
    std::vector<double> widths_m;
    double width_m = 0;
    for (const simulation::RayHit& hit : hits) {
        if (hit.kind == simulation::ObjectClass::Wire) {
            width_m += kStep_m;
        } else if (width_m > 0) {
            widths_m.push_back(std::exchange(width_m, 0.0));
        }
    }
    return widths_m;
}

TEST(CourseTest, WiresCrossTheStraightWayAboutAsHighAsOneFlies) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        for (const auto& [name, thickness_m] : {std::pair("wires", 0.024), {"wires-thin", 0.01}}) {
            const Course& c = course(name, seed);
            EXPECT_LT(leastClearanceStraight_m(c), 0.65) << name << ", seed " << seed;
            const std::vector<double> widths_m = wireWidths_m(c);
            EXPECT_GT(widths_m.size(), 2u) << name << ", seed " << seed;
            for (const double width_m : widths_m) EXPECT_NEAR(width_m, thickness_m, 0.0015);
        }
    }
}

TEST(CourseTest, ThinWiresHangWhereTheOthersDo) {
    const Course &thick = course("wires", 2), &thin = course("wires-thin", 2);
    simulation::Random random(4);
    int at_wires = 0;
    for (int i = 0; i < 20000; ++i) {
        const double x_m = random.uniform(0, 40), y_m = random.uniform(-8, 8);
        const Vector3f at = above(thick, x_m, y_m, random.uniform(1, 4));
        const float more_m = thin.distance.toStatic(at) - thick.distance.toStatic(at);
        ASSERT_GT(more_m, -1e-4f);
        ASSERT_LT(more_m, 0.0071f);
        at_wires += more_m > 0.0069f ? 1 : 0;
    }
    EXPECT_GT(at_wires, 1000);
}

/// Lamps and trees stand on both sides, every 10 m or up to 3 m from there.
TEST(CourseTest, LampsOfTheStreetStandNearTheirPlaces) {
    int lamps = 0;
    double farthest_m = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Course& c = course("street", seed);
        for (const simulation::SceneObject& object : c.scene.content().objects) {
            if (object.kind != simulation::ObjectClass::Pole) continue;
            const Eigen::Vector3f at_m = object.pose.translation();
            EXPECT_NEAR(std::abs(at_m.y()), 4.8, 1);
            const double along_m = std::remainder(static_cast<double>(at_m.x()) + 4, 10);
            EXPECT_LE(std::abs(along_m), 3 + 1e-5);
            farthest_m = std::max(farthest_m, std::abs(along_m));
            ++lamps;
        }
    }
    EXPECT_GT(lamps, 9);
    EXPECT_GT(farthest_m, 2);
}

/// Plants that are no obstacles: everywhere but in the street, lower than one flies.
TEST_P(EachCourse, HasTuftsOfTenToThirtyFiveCentimetres) {
    const Course& c = course(GetParam(), 1);
    double least_m = 1, most_m = 0;
    int tufts = 0;
    for (const simulation::SceneObject& object : c.scene.content().objects) {
        if (object.kind != simulation::ObjectClass::Canopy) continue;
        const auto height_m = static_cast<double>(object.pose.linear().col(2).norm());
        least_m = std::min(least_m, height_m);
        most_m = std::max(most_m, height_m);
        ++tufts;
    }
    if (GetParam() == "street") {
        EXPECT_EQ(tufts, 0);
        return;
    }
    EXPECT_GT(tufts, 20);
    EXPECT_GT(least_m, 0.099);
    EXPECT_LT(least_m, 0.15);
    EXPECT_GT(most_m, 0.2);
    EXPECT_LT(most_m, 0.351);
}

TEST(CourseTest, MoversGoAtOneToThreeMetresASecondAndCrossTheWay) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Course& c = course("movers", seed);
        ASSERT_EQ(c.scene.content().movers.size(), 6u);
        for (const simulation::MovingObstacle& mover : c.scene.content().movers) {
            const auto at = [&](double time_s) {
                return Eigen::Vector2d(simulation::poseOf(mover, c.scene.terrain(), time_s)
                                           .translation()
                                           .head<2>()
                                           .cast<double>());
            };
            const double speed_m_s = (at(5.05) - at(4.95)).norm() / 0.1;
            EXPECT_GT(speed_m_s, 0.99);
            EXPECT_LT(speed_m_s, 3.01);
            double least_y_m = 99, most_y_m = -99;
            for (double time_s = 0; time_s < 70; time_s += 0.2) {
                least_y_m = std::min(least_y_m, at(time_s).y());
                most_y_m = std::max(most_y_m, at(time_s).y());
            }
            EXPECT_LT(least_y_m, 0);
            EXPECT_GT(most_y_m, 0);
        }
    }
}

TEST(CourseTest, WhatIsHardIsInTheWay) {
    for (const char* name :
         {"forest-0.10", "orchard", "gap", "u-trap", "wires", "wires-thin", "street"}) {
        int blocked = 0;
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            blocked += leastClearanceStraight_m(course(name, seed)) < 0.45f ? 1 : 0;
        }
        EXPECT_EQ(blocked, 3) << name;
    }
}

TEST(CourseTest, AnUnknownNameIsToldWithThoseKnown) {
    try {
        makeCourse("moon", 1);
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), HasSubstr("'moon'"));
        EXPECT_THAT(error.what(), HasSubstr("u-trap"));
    }
}

TEST(CourseTest, ClearAirHasNeitherDustNorAirframe) {
    const simulation::SimulatedScan scan = scanAtStart(course("street", 1));
    for (const simulation::ObjectClass kind : scan.kind)
        ASSERT_TRUE(kind != simulation::ObjectClass::Dust &&
                    kind != simulation::ObjectClass::Airframe);
}

}  // namespace
}  // namespace hagen::avoidance
