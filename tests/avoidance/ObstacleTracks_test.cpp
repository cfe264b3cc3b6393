#include "avoidance/world_models/ObstacleTracks.h"
#include <gtest/gtest.h>
#include <hagen/avoidance/Planner.h>
#include <hagen/avoidance/WorldModel.h>
#include <hagen/simulation/Random.h>

#include <cmath>

namespace hagen::avoidance {
namespace {

/// An upright cylinder whose near half is visible from the origin.
struct Pillar {
    Eigen::Vector2d at_m;
    double radius_m = 0.25;
};

constexpr double kTurn_s = 0.1;
constexpr double kNoise_m = 0.02;

void addReturns(const Pillar& pillar, std::int32_t obstacle, double age_s,
                simulation::Random& random, observations::MappedScan& scan) {
    const double towards_rad = std::atan2(-pillar.at_m.y(), -pillar.at_m.x());
    for (double height_m = 0.1; height_m < 1.8; height_m += 0.3) {
        for (double side_rad = -1.4; side_rad <= 1.4; side_rad += 0.35) {
            const double radius_m = pillar.radius_m + kNoise_m * random.normal();
            const Eigen::Vector2d at_m =
                pillar.at_m + radius_m * Eigen::Vector2d(std::cos(towards_rad + side_rad),
                                                         std::sin(towards_rad + side_rad));
            scan.points_m.emplace_back(Eigen::Vector3d(at_m.x(), at_m.y(), height_m).cast<float>());
            scan.labels.push_back(Label::Roi);
            scan.obstacles.push_back(obstacle);
            scan.age_s.push_back(static_cast<float>(age_s));
        }
    }
}

observations::MappedScan scanAt(int number) {
    observations::MappedScan scan;
    scan.time_s = kTurn_s * (number + 1);
    scan.origin_m = {0, 0, 1};
    return scan;
}

/// Adds a surrounding wall behind everything.
void addBackground(observations::MappedScan& scan) {
    constexpr double kStep_rad = 0.02, kRadius_m = 12;
    for (double azimuth_rad = 0; azimuth_rad < 2 * M_PI; azimuth_rad += kStep_rad) {
        for (double height_m = -0.4; height_m < 3; height_m += 0.35) {
            const Eigen::Vector3d at_m(kRadius_m * std::cos(azimuth_rad),
                                       kRadius_m * std::sin(azimuth_rad), height_m);
            scan.points_m.push_back(at_m.cast<float>());
            scan.labels.push_back(Label::Rou);
            scan.obstacles.push_back(0);
            scan.age_s.push_back(0.05f);
        }
    }
}

/// The pillar's position at a constant velocity.
Pillar moved(const Pillar& pillar, const Eigen::Vector2d& velocity_m_s, double time_s) {
    return {pillar.at_m + time_s * velocity_m_s, pillar.radius_m};
}

const Pillar kWalker{{6, -3}};
const Eigen::Vector2d kWalk_m_s(0.3, 1.5);

/// Scans of a moving and a standing pillar.
std::vector<observations::MappedScan> walkerAndPost(int scans, double age_s = 0.04) {
    simulation::Random random(1);
    std::vector<observations::MappedScan> all;
    for (int number = 0; number < scans; ++number) {
        observations::MappedScan scan = scanAt(number);
        // Obstacle numbers change between scans, as the nearest obstacle is 1.
        const bool is_swapped = number % 2 == 1;
        addReturns(moved(kWalker, kWalk_m_s, scan.time_s - age_s), is_swapped ? 2 : 1, age_s,
                   random, scan);
        addReturns({{4, 4}}, is_swapped ? 1 : 2, 0.07, random, scan);
        addBackground(scan);
        all.push_back(std::move(scan));
    }
    return all;
}

ObstacleTrack trackNear(const ObstacleTracks& tracks, const Eigen::Vector2d& at_m) {
    return *std::min_element(tracks.tracks().begin(), tracks.tracks().end(),
                             [&](const auto& a, const auto& b) {
                                 return (a.at_m - at_m).norm() < (b.at_m - at_m).norm();
                             });
}

TEST(ObstacleTracks, SurviveChangingNumbers) {
    ObstacleTracks tracks;
    for (const auto& scan : walkerAndPost(10)) tracks.update(scan);
    ASSERT_EQ(tracks.tracks().size(), 2u);
    for (const ObstacleTrack& track : tracks.tracks()) EXPECT_EQ(track.seen_scans, 10);
    // In the tenth scan, the numbers are swapped.
    EXPECT_EQ(tracks.trackOfObstacle(), (std::vector<std::uint32_t>{0, 2, 1}));
}

TEST(ObstacleTracks, EstimateVelocities) {
    ObstacleTracks tracks;
    for (const auto& scan : walkerAndPost(12)) tracks.update(scan);
    const ObstacleTrack walker = trackNear(tracks, moved(kWalker, kWalk_m_s, 1.2).at_m);
    EXPECT_TRUE(walker.is_moving);
    EXPECT_LT((walker.velocity_m_s - kWalk_m_s).norm(), 0.25);
    EXPECT_NEAR(walker.time_s, 1.2 - 0.04, 1e-6);  // when its returns were measured
    const ObstacleTrack post = trackNear(tracks, {4, 4});
    EXPECT_FALSE(post.is_moving);
    EXPECT_LT(post.velocity_m_s.norm(), 0.2);
}

/// Scans of a moving pillar, cropped at a maximum height.
std::vector<observations::MappedScan> slicesOfWalker(double max_height_m) {
    simulation::Random random(5);
    std::vector<observations::MappedScan> all;
    for (int number = 0; number < 14; ++number) {
        observations::MappedScan whole = scanAt(number), scan = whole;
        addReturns(moved(kWalker, kWalk_m_s, whole.time_s), 1, 0, random, whole);
        for (std::size_t i = 0; i < whole.points_m.size(); ++i) {
            const auto above_m = static_cast<double>(whole.points_m[i].z()) - 0.7;
            if (std::abs(above_m) > max_height_m / 2) continue;
            scan.points_m.push_back(whole.points_m[i]);
            scan.labels.push_back(Label::Roi);
            scan.obstacles.push_back(1);
            scan.age_s.push_back(0);
        }
        all.push_back(std::move(scan));
    }
    return all;
}

int movingScans(std::vector<observations::MappedScan> scans, int first_with_background,
                int last_with_background) {
    ObstacleTracks tracks;
    int moving = 0;
    for (int number = 0; number < static_cast<int>(scans.size()); ++number) {
        observations::MappedScan& scan = scans[static_cast<std::size_t>(number)];
        if (number >= first_with_background && number <= last_with_background) {
            addBackground(scan);
        }
        tracks.update(scan);
        for (const ObstacleTrack& track : tracks.tracks()) moving += track.is_moving;
    }
    return moving;
}

// If no scan sees past a return, it may belong to another part of a static object.
TEST(ObstacleTracks, MotionRequiresCrossingFreeSpace) {
    constexpr int kNever = 100;
    const auto walker = slicesOfWalker(1.5);
    EXPECT_EQ(movingScans(walker, kNever, kNever), 0);
    EXPECT_GT(movingScans(walker, 0, kNever), 5);
    EXPECT_GT(movingScans(walker, 8, kNever), 2) << "background now visible at the old position";
    EXPECT_GT(movingScans(walker, 0, 1), 2) << "background earlier visible at the new position";
}

// Rays pass a wire at the old and new positions of its segments.
TEST(ObstacleTracks, FlatObstaclesNeedBothCriteria) {
    const auto slice = slicesOfWalker(0.1);
    EXPECT_GT(slice[0].points_m.size(), 3u);
    EXPECT_GT(movingScans(slice, 0, 100), 5);
    EXPECT_EQ(movingScans(slice, 13, 100), 0) << "background now visible at the old position";
    EXPECT_EQ(movingScans(slice, 0, 1), 0) << "background earlier visible at the new position";
}

// While a wall comes into view, its centre moves at 3 m/s, but its points do not.
TEST(ObstacleTracks, GrowingWallDoesNotMove) {
    ObstacleTracks tracks;
    simulation::Random random(2);
    for (int number = 0; number < 10; ++number) {
        observations::MappedScan scan = scanAt(number);
        for (float x_m = 2; x_m < 2.5f + 0.6f * static_cast<float>(number); x_m += 0.1f) {
            for (float z_m = 0.5f; z_m < 2; z_m += 0.5f) {
                scan.points_m.emplace_back(x_m, 3 + static_cast<float>(kNoise_m * random.normal()),
                                           z_m);
                scan.labels.push_back(Label::Roi);
                scan.obstacles.push_back(1);
                scan.age_s.push_back(0);
            }
        }
        tracks.update(scan);
        for (const ObstacleTrack& track : tracks.tracks()) EXPECT_FALSE(track.is_moving) << number;
    }
}

TEST(ObstacleTracks, NoiseCausesNoMotion) {
    simulation::Random random(3);
    ObstacleTracks tracks;
    int moving = 0;
    for (int number = 0; number < 100; ++number) {
        observations::MappedScan scan = scanAt(number);
        for (int post = 0; post < 20; ++post) {
            const double angle_rad = 0.3 * post;
            addReturns({{8 * std::cos(angle_rad), 8 * std::sin(angle_rad)}}, post + 1, 0.05, random,
                       scan);
        }
        tracks.update(scan);
        for (const ObstacleTrack& track : tracks.tracks()) moving += track.is_moving;
    }
    EXPECT_EQ(tracks.tracks().size(), 20u);
    EXPECT_EQ(moving, 0);  // 2000 tracks are checked
}

TEST(ObstacleTracks, SurviveNineHiddenScans) {
    ObstacleTracks tracks;
    const auto scans = walkerAndPost(18);
    for (int number = 0; number < 18; ++number) {
        observations::MappedScan scan = scans[static_cast<std::size_t>(number)];
        const bool is_hidden = number >= 8 && number < 17;
        if (is_hidden) scan.obstacles.assign(scan.obstacles.size(), 0);
        tracks.update(scan);
    }
    EXPECT_EQ(tracks.tracks().size(), 2u);
    // The track is moving at once, even without an earlier scan for comparison.
    EXPECT_TRUE(trackNear(tracks, moved(kWalker, kWalk_m_s, 1.8).at_m).is_moving);
    // After a longer gap, tracks are dropped.
    for (int number = 18; number < 30; ++number) tracks.update(scanAt(number));
    EXPECT_TRUE(tracks.tracks().empty());
}

TEST(ObstacleTracks, NeedObstacleNumbers) {
    ObstacleTracks tracks;
    observations::MappedScan scan = walkerAndPost(1)[0];
    scan.obstacles.clear();
    tracks.update(scan);
    tracks.update(observations::MappedScan{});
    EXPECT_TRUE(tracks.tracks().empty());
    EXPECT_EQ(tracks.trackOfObstacle(), (std::vector<std::uint32_t>{0}));
}

// ---- the window model with motion

std::unique_ptr<WorldModel> modelOf(const std::string& name,
                                    const std::vector<observations::MappedScan>& scans) {
    auto model = makeWorldModel(
        name,
        {Eigen::AlignedBox3f(Eigen::Vector3f(-9, -9, -2), Eigen::Vector3f(9, 9, 5)), nullptr, {}});
    for (const observations::MappedScan& scan : scans) model->update(scan);
    return model;
}

TEST(WindowWithMotion, PredictsMoversWithoutTrail) {
    const auto scans = walkerAndPost(12);
    const auto moving = modelOf("W-RoI+motion", scans), standing = modelOf("W-RoI", scans);
    const auto placeAfter = [&](double after_s) {
        const Eigen::Vector2d at_m = moved(kWalker, kWalk_m_s, 1.2 + after_s).at_m;
        return Eigen::Vector3d(at_m.x(), at_m.y(), 1).cast<float>().eval();
    };
    EXPECT_GT(moving->fastest_m_s(), 1.5f);
    for (const double after_s : {0.0, 0.5, 1.0}) {
        EXPECT_LT(moving->clearanceAfter_m(placeAfter(after_s), after_s), 0.3f) << after_s;
    }
    EXPECT_GT(moving->clearanceAfter_m(placeAfter(0), 1.0), 0.8f);
    EXPECT_FLOAT_EQ(moving->clearance_m(placeAfter(0)), moving->clearanceAfter_m(placeAfter(0), 0));
    // The walker's position 0.8 s ago.
    EXPECT_GT(moving->clearance_m(placeAfter(-0.8)), 0.6f);
    EXPECT_LT(standing->clearance_m(placeAfter(-0.8)), 0.3f);
    EXPECT_EQ(standing->fastest_m_s(), 0);
}

TEST(MapWithMotion, PredictsMoversAndKeepsMap) {
    const auto scans = walkerAndPost(12);
    for (const std::string name : {"G-Full", "R-Full-0.2"}) {
        const auto moving = modelOf(name + "+motion", scans), standing = modelOf(name, scans);
        EXPECT_GT(moving->fastest_m_s(), 1.5f) << name;
        const auto placeAfter = [&](double after_s) {
            const Eigen::Vector2d at_m = moved(kWalker, kWalk_m_s, 1.2 + after_s).at_m;
            return Eigen::Vector3d(at_m.x(), at_m.y(), 1).cast<float>().eval();
        };
        for (const double after_s : {0.0, 0.5, 1.0}) {
            EXPECT_LT(moving->clearanceAfter_m(placeAfter(after_s), after_s), 0.3f) << name;
        }
        EXPECT_GT(moving->clearanceAfter_m(placeAfter(0), 1.0), 0.5f) << name;
        EXPECT_LT(standing->clearanceAfter_m(placeAfter(0), 1.0), 0.4f) << name;
        const Eigen::Vector3f by_the_post_m(3, 3, 1);
        EXPECT_FLOAT_EQ(moving->clearance_m(by_the_post_m), standing->clearance_m(by_the_post_m));
    }
}

/// The first scan contains a post; later scans have only the walker's returns behind it.
TEST(MapWithMotion, RaysToMoversClearMap) {
    const Eigen::Vector2d post(3.1, -0.72);
    const double azimuth_rad = std::atan2(post.y(), post.x());
    auto scans = walkerAndPost(14);
    simulation::Random random(2);
    for (observations::MappedScan& scan : scans) {
        observations::MappedScan rest = scan;
        rest.points_m.clear();
        rest.labels.clear();
        rest.obstacles.clear();
        rest.age_s.clear();
        for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
            const Eigen::Vector3d at_m = scan.points_m[i].cast<double>();
            const double beside_rad = std::atan2(at_m.y(), at_m.x()) - azimuth_rad;
            if (scan.obstacles[i] == 0 && std::abs(beside_rad) < 0.1) continue;
            rest.points_m.push_back(scan.points_m[i]);
            rest.labels.push_back(scan.labels[i]);
            rest.obstacles.push_back(scan.obstacles[i]);
            rest.age_s.push_back(scan.age_s[i]);
        }
        scan = std::move(rest);
    }
    addReturns({post, 0.05}, 0, 0.04, random, scans.front());
    const Eigen::Vector3f by_the_post_m(2.7f, -0.62f, 1);
    for (const std::string name : {"G-Full", "R-Full-0.2"}) {
        const auto before = modelOf(name + "+motion", {scans.begin(), scans.begin() + 6});
        EXPECT_LT(before->clearance_m(by_the_post_m), 0.5f) << name;
        EXPECT_GT(modelOf(name + "+motion", scans)->clearance_m(by_the_post_m), 0.6f) << name;
    }
}

TEST(WindowWithMotion, EqualsWindowWithoutMovers) {
    std::vector<observations::MappedScan> scans;
    simulation::Random random(4);
    for (int number = 0; number < 10; ++number) {
        scans.push_back(scanAt(number));
        addReturns({{4, 1}}, 1, 0, random, scans.back());
        addReturns({{-3, 2}, 0.6}, 2, 0, random, scans.back());
    }
    const auto moving = modelOf("W-RoI+motion", scans), standing = modelOf("W-RoI", scans);
    EXPECT_EQ(moving->fastest_m_s(), 0);
    for (int i = 0; i < 500; ++i) {
        const Eigen::Vector3f at_m(static_cast<float>(random.uniform(-6, 6)),
                                   static_cast<float>(random.uniform(-6, 6)),
                                   static_cast<float>(random.uniform(0, 3)));
        EXPECT_EQ(moving->clearance_m(at_m), standing->clearance_m(at_m));
        EXPECT_EQ(moving->clearanceAfter_m(at_m, 0.7), standing->clearance_m(at_m));
    }
}

// ---- the planner

/// A ball that approaches along the x axis.
class BallModel : public WorldModel {
 public:
    static constexpr float kFirst_m = 6, kSpeed_m_s = 3, kRadius_m = 0.5f;
    explicit BallModel(bool knows_motion) : BallModel(knows_motion ? kSpeed_m_s : 0) {}
    explicit BallModel(float speed_m_s) : speed_m_s_(speed_m_s) {}

    void update(const observations::MappedScan&) override {}
    float clearance_m(const Eigen::Vector3f& p) const override { return clearanceAfter_m(p, 0); }
    float clearanceAfter_m(const Eigen::Vector3f& p, double after_s) const override {
        const Eigen::Vector3f ball_m(kFirst_m - speed_m_s_ * static_cast<float>(after_s), 0, 2);
        return std::clamp((p - ball_m).norm() - kRadius_m, 0.0f, kReach_m);
    }
    float fastest_m_s() const override { return std::abs(speed_m_s_); }
    bool isKnown(const Eigen::Vector3f&) const override { return true; }
    std::size_t bytes() const override { return 0; }
    Obstacles obstacles() const override { return {}; }

 private:
    float speed_m_s_;
};

/// The minimum distance from the ball's surface within 2 s if the command is held for 1.2 s.
double nearestWay_m(const Eigen::Vector3d& command_m_s, double ball_first_m) {
    VehicleState state{{0, 0, 2}, {0, 0, 0}};
    double min_m = 1e9;
    for (double time_s = 0; time_s < 2; time_s += kControlStep_s) {
        const Eigen::Vector3d ball_m(ball_first_m - 3 * time_s, 0, 2);
        min_m = std::min(min_m, (state.position_m - ball_m).norm() - 0.5);
        const Eigen::Vector3d held_m_s = time_s < 1.2 ? command_m_s : Eigen::Vector3d::Zero();
        state = advance(state, held_m_s, kControlStep_s, {});
    }
    return min_m;
}

PlanningTask taskTowards(const Eigen::Vector3d& carrot_m, double start_after_s) {
    PlanningTask task;
    task.start.position_m = {0, 0, 2};
    task.carrot_m = carrot_m;
    task.start_after_s = start_after_s;
    return task;
}

// There is room to stop straight ahead, but the ball approaches.
TEST(MotionPrimitives, AvoidApproachingObstacle) {
    const PlanningTask task = taskTowards({12, 0, 2}, 0.3);
    const double ball_m = 6 - 3 * 0.3;
    const auto planner = makePlanner("primitives");
    const Plan still = planner->plan(BallModel(false), task);
    const Plan plan = planner->plan(BallModel(true), task);
    EXPECT_FALSE(plan.is_emergency);
    EXPECT_GT(nearestWay_m(plan.command_m_s, ball_m), 0.6);
    EXPECT_LT(nearestWay_m(still.command_m_s, ball_m), 0.3);
}

// The ball blocks the path, or leaves it before the vehicle arrives.
TEST(PolarHistogram, RanksDirectionsByPrediction) {
    const PlanningTask task = taskTowards({20, 0, 2}, 0);
    const auto planner = makePlanner("3dvfh");
    EXPECT_EQ(planner->plan(BallModel(-3.0f), task).command_m_s.y(), 0);
    EXPECT_GT(std::abs(planner->plan(BallModel(false), task).command_m_s.y()), 0.3);
}

TEST(MotionPrimitives, EvadeWhenNothingIsFree) {
    // The vehicle hovers at the goal; the ball's surface is 1.15 m away and arrives in 0.4 s.
    const PlanningTask task = taskTowards({0, 0, 2}, 1.45);
    const double ball_m = 6 - 3 * 1.45;
    const Plan plan = makePlanner("primitives")->plan(BallModel(true), task);
    EXPECT_TRUE(plan.is_emergency);
    EXPECT_GT(plan.command_m_s.norm(), 3);
    EXPECT_GT(nearestWay_m(plan.command_m_s, ball_m), nearestWay_m({0, 0, 0}, ball_m) + 0.2);
    // In a static world, hovering is safe.
    PlanningTask near = task;
    near.start.position_m.x() = 5.2;
    near.start_after_s = 0;
    const Plan brakes = makePlanner("primitives")->plan(BallModel(false), near);
    EXPECT_TRUE(!brakes.is_emergency || brakes.command_m_s.isZero());
}

TEST(MotionPrimitives, EvasionRespectsLimits) {
    PlanningTask task = taskTowards({0, 0, 2}, 1.45);
    const auto heightOf = [](const Plan& plan) { return plan.command_m_s.z(); };
    const auto planner = makePlanner("primitives");
    // The ball's centre is above, so the vehicle evades downwards if the altitude limit allows.
    task.start.position_m.z() = 1.9;
    EXPECT_LT(heightOf(planner->plan(BallModel(true), task)), 0);
    task.lowest_m = 1.9;
    EXPECT_GE(heightOf(planner->plan(BallModel(true), task)), 0);
    task.lowest_m = 1;
    // In unknown space the vehicle brakes.
    class UnknownSpace : public BallModel {
     public:
        using BallModel::BallModel;
        bool isKnown(const Eigen::Vector3f&) const override { return false; }
    };
    task.brakes_in_known_space = true;
    EXPECT_TRUE(planner->plan(UnknownSpace(true), task).command_m_s.isZero());
    EXPECT_FALSE(planner->plan(BallModel(true), task).command_m_s.isZero());
}

}  // namespace
}  // namespace hagen::avoidance
