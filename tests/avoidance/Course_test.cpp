#include <gmock/gmock.h>
#include <hagen/avoidance/Course.h>
#include <hagen/scan/Angle.h>
#include "avoidance/flights/TrialSensor.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "support/Program.h"

namespace hagen::avoidance {
namespace {

using testing::HasSubstr;

using Eigen::Vector3d;
using Eigen::Vector3f;

/// Caches courses, because they are expensive to build.
const Course& course(std::string_view name, std::uint64_t seed) {
    static std::map<std::pair<std::string, std::uint64_t>, Course> made;
    const std::pair key(std::string(name), seed);
    if (made.count(key) == 0) made.emplace(key, makeCourse(key.first, seed));
    return made.at(key);
}

Vector3f above(const Course& course, double x_m, double y_m, double height_m) {
    return Vector3d(x_m, y_m, course.scene.terrain().height_m(x_m, y_m) + height_m).cast<float>();
}

/// The minimum clearance from static objects on the straight path at the requested altitude.
float minClearanceStraight_m(const Course& course) {
    float min_m = 1e9f;
    for (double x_m = course.start_m.x(); x_m <= course.goal_m.x(); x_m += 0.05) {
        min_m = std::min(min_m, course.distance.toStatic(above(course, x_m, 0, course.altitude_m)));
    }
    return min_m;
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

/// Distance to the nearest standing or moving object, by rays in all directions.
double nearestObject_m(const Course& course, const Vector3f& from, double time_s) {
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

TEST_P(EachCourse, HasFreeEndsAndPath) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Course& c = course(GetParam(), seed);
        EXPECT_EQ(c.scenario, GetParam());
        EXPECT_EQ(c.seed, seed);
        EXPECT_NEAR((c.goal_m - c.start_m).head<2>().norm(), 40, 1e-9);
        EXPECT_TRUE(c.bounds_m.contains(c.start_m) && c.bounds_m.contains(c.goal_m));
        const double straight_m = (c.goal_m - c.start_m).norm();
        EXPECT_GE(c.oracle_path_m, straight_m - 1e-9);
        EXPECT_LE(c.oracle_path_m, 1.35 * straight_m) << "seed " << seed;
        for (const Vector3d& end : {c.start_m, c.goal_m}) {
            const double ground_m = c.scene.terrain().height_m(end.x(), end.y());
            EXPECT_NEAR(end.z() - ground_m, c.altitude_m, 1e-9);
            for (double time_s = 0; time_s < 30; time_s += 3) {
                EXPECT_GT(nearestObject_m(c, end.cast<float>(), time_s), 2.0) << "seed " << seed;
            }
        }
    }
}

TEST_P(EachCourse, DependsOnSeedOnly) {
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

TEST(CourseTest, ForestMatchesDensity) {
    for (const auto& [name, per_m2] :
         std::map<std::string, double>{{"forest-0.02", 0.02}, {"forest-0.10", 0.10}}) {
        const double expected = per_m2 * 56 * 34;  // minus the trees within 3.9 m of both ends
        double mean = 0;
        for (std::uint64_t seed = 1; seed <= 3; ++seed)
            mean += count(course(name, seed), simulation::ObjectClass::Tree) / 3.0;
        EXPECT_NEAR(mean, expected - per_m2 * 2 * kPi * 3.9 * 3.9, 2.5 * std::sqrt(expected / 3))
            << name;
    }
}

TEST(CourseTest, TrapBlocksAllAltitudes) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Course& c = course("u-trap", seed);
        for (const double height_m : {1.0, 2.0, 4.5}) {
            float min_m = 9;
            for (double x_m = 15; x_m < 32; x_m += 0.05) {
                min_m = std::min(min_m, c.distance.toStatic(above(c, x_m, 0, height_m)));
            }
            EXPECT_LT(min_m, 0.05f) << "seed " << seed << ", " << height_m << " m";
        }
        EXPECT_GT(c.oracle_path_m, 40.5);
    }
}

/// Widths of the wires hit by a dense row of upward rays from below the straight path.
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

TEST(CourseTest, WiresCrossStraightPath) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        for (const auto& [name, thickness_m] : {std::pair("wires", 0.024), {"wires-thin", 0.005}}) {
            const Course& c = course(name, seed);
            EXPECT_LT(minClearanceStraight_m(c), 0.65) << name << ", seed " << seed;
            const std::vector<double> widths_m = wireWidths_m(c);
            EXPECT_GT(widths_m.size(), 2u) << name << ", seed " << seed;
            for (const double width_m : widths_m) EXPECT_NEAR(width_m, thickness_m, 0.0015);
        }
    }
}

TEST(CourseTest, MoversCrossPathAtSpeed) {
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
            double min_y_m = 99, max_y_m = -99;
            for (double time_s = 0; time_s < 70; time_s += 0.2) {
                min_y_m = std::min(min_y_m, at(time_s).y());
                max_y_m = std::max(max_y_m, at(time_s).y());
            }
            EXPECT_LT(min_y_m, 0);
            EXPECT_GT(max_y_m, 0);
        }
    }
}

TEST(CourseTest, ObstaclesBlockStraightPath) {
    for (const char* name :
         {"forest-0.10", "orchard", "gap", "u-trap", "wires", "wires-thin", "street"}) {
        int blocked = 0;
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            blocked += minClearanceStraight_m(course(name, seed)) < 0.45f ? 1 : 0;
        }
        EXPECT_EQ(blocked, 3) << name;
    }
}

TEST(CourseTest, RejectsUnknownName) {
    EXPECT_THAT(test::messageOf<std::invalid_argument>([] { makeCourse("moon", 1); }),
                testing::AllOf(HasSubstr("'moon'"), HasSubstr("u-trap")));
}

}  // namespace
}  // namespace hagen::avoidance
