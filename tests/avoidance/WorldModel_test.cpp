#include <gmock/gmock.h>
#include <hagen/avoidance/WorldModel.h>
#include <hagen/simulation/Random.h>
#include <malloc.h>
#include "avoidance/world_models/SeenDirections.h"

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "support/Program.h"

namespace hagen::avoidance {
namespace {

using testing::HasSubstr;

const Eigen::AlignedBox3f kBounds(Eigen::Vector3f(-6, -6, -2), Eigen::Vector3f(10, 6, 4));
const Eigen::Vector3f kOrigin(0.03f, 0.05f, 1.07f);

WorldModelSetting setting() {
    return {kBounds,
            [](const Eigen::Vector3f& p, double after_s) {
                return std::abs(5 - p.x() - static_cast<float>(after_s));
            },
            {},
            ModelDistance::AsStored};
}

std::vector<std::string> modelsThatLearn() {
    std::vector<std::string> names = worldModelNames();
    names.erase(std::remove_if(names.begin(), names.end(), needsTruth), names.end());
    return names;
}

/// Edge length of a model's voxels; 0 for points.
float edgeOf(const std::string& name) {
    if (name[0] == 'W') return 0;
    if (name.find("0.1") != std::string::npos) return 0.1f;
    return name.find("0.4") != std::string::npos ? 0.4f : 0.2f;
}

observations::MappedScan scanOf(const std::vector<Eigen::Vector3f>& points,
                                Label label = Label::Roi) {
    return {0, kOrigin, points, std::vector<Label>(points.size(), label), {}, {}};
}

/// A dense wall, by default at x = 5.1 m.
std::vector<Eigen::Vector3f> wall(float x_m = 5.1f) {
    std::vector<Eigen::Vector3f> points;
    for (float y = -4; y <= 4; y += 0.07f) {
        for (float z = -0.5f; z <= 3; z += 0.07f) points.emplace_back(x_m, y, z);
    }
    return points;
}

/// A board of 1.4 x 0.6 m at x = 3.1 m, in front of the wall.
std::vector<Eigen::Vector3f> board() {
    std::vector<Eigen::Vector3f> points;
    for (float y = -0.7f; y <= 0.7f; y += 0.05f) {
        for (float z = 0.8f; z <= 1.4f; z += 0.05f) points.emplace_back(3.1f, y, z);
    }
    return points;
}

/// A few points all around, so that no ray clears another's end point.
std::vector<Eigen::Vector3f> sparsePoints(simulation::Random& random, int count) {
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < count; ++i) {
        const double x = random.uniform(-5, 8);
        const double y = random.uniform(-5, 5);
        const double z = random.uniform(-1, 3);
        points.push_back(Eigen::Vector3d(x, y, z).cast<float>());
    }
    return points;
}

/// Duplicates each point, so that none is isolated.
std::vector<Eigen::Vector3f> twice(std::vector<Eigen::Vector3f> points) {
    points.insert(points.end(), points.begin(), points.end());
    return points;
}

float nearestOf(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& at) {
    float min = WorldModel::kReach_m;
    for (const auto& point : points) min = std::min(min, (point - at).norm());
    return min;
}

TEST(WorldModel, ClearanceMatchesBruteForce) {
    for (const std::string& name : modelsThatLearn()) {
        simulation::Random random(7);
        const auto points = sparsePoints(random, 60);
        const auto model = makeWorldModel(name, setting());
        model->update(scanOf(twice(points)));
        // A cube is nearer than its point by at most its diagonal. Distances refer to cube centres.
        const float diagonal = std::sqrt(3.0f) * edgeOf(name);
        // In a grid, rays clear cells that other rays hit.
        const bool is_whole = name != "G-Full";
        for (int i = 0; i < 400; ++i) {
            const Eigen::Vector3f at = sparsePoints(random, 1)[0];
            const float expected = nearestOf(points, at);
            const float clearance = model->clearance_m(at);
            EXPECT_GE(clearance, expected - diagonal - 1e-4f) << name;
            if (is_whole) {
                EXPECT_LE(clearance, expected + diagonal + 1e-4f) << name;
            }
        }
    }
}

TEST(WorldModel, MeasuresDistanceToWall) {
    for (const std::string& name : worldModelNames()) {
        const auto model = makeWorldModel(name, setting());
        for (int i = 0; i < 3; ++i) model->update(scanOf(wall()));
        const float edge = edgeOf(name);
        for (float x = 2.3f; x < 4.5f; x += 0.11f) {
            const float clearance = model->clearance_m({x, 0.1f, 1.1f});
            EXPECT_GE(5.1f - x + 0.05f, clearance) << name << " " << x;
            EXPECT_LE(5.1f - x - edge - 0.11f, clearance) << name << " " << x;
        }
        EXPECT_EQ(WorldModel::kReach_m, model->clearance_m({-4, 0, 1})) << name;
        if (needsTruth(name)) continue;
        EXPECT_LE(model->clearance_m({5.1f, 0.1f, 1.1f}), edge > 0 ? 0.0f : 0.05f) << name;
    }
}

TEST(WorldModel, IsFreeAndUnknownBeforeScans) {
    for (const std::string& name : modelsThatLearn()) {
        const auto model = makeWorldModel(name, setting());
        for (int i = 0; i < 2; ++i) {
            EXPECT_EQ(WorldModel::kReach_m, model->clearance_m({1, 1, 1})) << name;
            EXPECT_FALSE(model->isKnown({1, 1, 1})) << name;
            EXPECT_TRUE(model->obstacles().centre_m.empty()) << name;
            model->update({});  // an empty scan
        }
    }
}

TEST(WorldModel, AcceptsQueriesOutsideBounds) {
    for (const std::string& name : worldModelNames()) {
        const auto model = makeWorldModel(name, setting());
        model->update(scanOf({{1, 1, 1}, {500, 1, 1}, {1, -500, 1}, {1, 1, 500}}));
        for (const float far : {11.0f, 100.0f, 9000.0f, -11.0f, -9000.0f}) {
            for (int axis = 0; axis < 3; ++axis) {
                Eigen::Vector3f at(0, 0, 0);
                at[axis] = far;
                EXPECT_GE(model->clearance_m(at), 0) << name;
                EXPECT_LE(model->clearance_m(at), WorldModel::kReach_m) << name;
                model->isKnown(at);
            }
        }
    }
}

TEST(WorldModel, SeesObstacleBesideBounds) {
    for (const std::string& name : modelsThatLearn()) {
        const auto model = makeWorldModel(name, setting());
        model->update(scanOf(twice({{0.1f, 6.5f, 1.1f}})));
        EXPECT_NEAR(0.7f, model->clearance_m({0.1f, 5.8f, 1.1f}), 0.4f) << name;
    }
}

TEST(WorldModel, SeenSpaceIsKnown) {
    for (const std::string& name : modelsThatLearn()) {
        const auto model = makeWorldModel(name, setting());
        model->update(scanOf(wall()));
        EXPECT_TRUE(model->isKnown({3.1f, 0.1f, 1.1f})) << name;
        EXPECT_FALSE(model->isKnown({5.9f, 0.1f, 1.1f})) << name << ": behind the wall";
        EXPECT_FALSE(model->isKnown({-3, 0, 1})) << name << ": behind the sensor";
    }
}

TEST(WorldModel, RoiModelsIgnoreOtherReturns) {
    for (const std::string& name : modelsThatLearn()) {
        const auto model = makeWorldModel(name, setting());
        for (int i = 0; i < 3; ++i) model->update(scanOf(wall(), Label::Rou));
        EXPECT_EQ(name.find("RoI") != std::string::npos,
                  model->clearance_m({4.1f, 0.1f, 1.1f}) > 2.5f)
            << name;
        const bool knows = name.find("O-RoI-") == std::string::npos;
        EXPECT_EQ(knows, model->isKnown({3.1f, 0.1f, 1.1f})) << name;
    }
}

/// Compares with all points of the last 11 turns; thinning may keep another point per 10 cm.
TEST(WorldModel, SectorWindowMatchesBruteForce) {
    simulation::Random random(17);
    const auto model = makeWorldModel("W-Full", setting());
    std::vector<std::pair<double, std::vector<Eigen::Vector3f>>> updates;
    for (int i = 0; i < 150; ++i) {
        // Like a planner that is sometimes late: updates cover one sector to more than a turn.
        const double turns = i % 7 == 3 ? random.uniform(0.04, 1.3) : 0.2;
        updates.emplace_back(turns, twice(sparsePoints(random, 6)));
        observations::MappedScan sectors = scanOf(updates.back().second);
        sectors.turns = turns;
        model->update(sectors);
        if (i % 10 != 9) continue;
        std::vector<Eigen::Vector3f> known;
        double sum = 0;
        for (auto at = updates.rbegin(); at != updates.rend() && sum < 11 - 1e-6; ++at) {
            known.insert(known.end(), at->second.begin(), at->second.end());
            sum += at->first;
        }
        const auto held = static_cast<double>(model->obstacles().centre_m.size());
        EXPECT_NEAR(2 * held, static_cast<double>(known.size()), 20);
        for (int query = 0; query < 40; ++query) {
            const Eigen::Vector3f at = sparsePoints(random, 1)[0];
            EXPECT_NEAR(model->clearance_m(at), nearestOf(known, at), 0.1732f);
        }
    }
}

/// A ray that ends beyond a map's range adds no obstacle within it.
TEST(WorldModel, CutRaysAddNoObstacle) {
    const Eigen::AlignedBox3f wide(Eigen::Vector3f(-30, -30, -3), Eigen::Vector3f(30, 30, 6));
    std::vector<Eigen::Vector3f> far_off;
    for (float y = -12; y <= 12; y += 0.2f) far_off.emplace_back(25.0f, y, 1.3f);
    for (const std::string& name : modelsThatLearn()) {
        const auto model = makeWorldModel(name, {wide, nullptr, {}});
        model->update(scanOf(far_off));
        EXPECT_TRUE(model->obstacles().centre_m.empty()) << name;
        EXPECT_EQ(model->clearance_m({20, 0.1f, 1.3f}), WorldModel::kReach_m) << name;
    }
}

TEST(WorldModel, RangeGrowsWithSpeed) {
    const Eigen::AlignedBox3f wide(Eigen::Vector3f(-30, -30, -3), Eigen::Vector3f(30, 30, 6));
    std::vector<Eigen::Vector3f> wall_m;
    for (float y = -3; y <= 3; y += 0.2f) wall_m.emplace_back(25.0f, y, 1.3f);
    for (const std::string& name : modelsThatLearn()) {
        const auto model = makeWorldModel(name, {wide, nullptr, {10, 0.1, {}}});
        model->update(scanOf(twice(wall_m)));
        EXPECT_LT(model->clearance_m({24, 0.1f, 1.3f}), 1.5f) << name;
    }
}

TEST(WorldModel, LimitedClearanceIsCutOff) {
    for (const std::string& name : modelsThatLearn()) {
        simulation::Random random(8);
        const auto model = makeWorldModel(name, setting());
        for (int scan = 0; scan < 3; ++scan) model->update(scanOf(sparsePoints(random, 40)));
        for (int i = 0; i < 200; ++i) {
            const Eigen::Vector3f at = sparsePoints(random, 1)[0];
            for (const float limit_m : {0.3f, 1.2f, 9.0f}) {
                EXPECT_FLOAT_EQ(model->clearanceWithin_m(at, limit_m),
                                std::min(model->clearance_m(at), limit_m))
                    << name;
            }
        }
    }
}

/// Brute force keeps the point nearest to the origin per 10 cm cube. Thus a clearance is never
/// below the true one and exceeds it by at most a cube's diagonal.
TEST(WorldModel, WindowKeepsNearestPointPerCube) {
    constexpr float kEdge_m = 0.1f;
    simulation::Random random(10);
    for (int round = 0; round < 20; ++round) {
        std::vector<Eigen::Vector3f> points;
        for (int i = 0; i < 400; ++i) {
            const Eigen::Vector3d at(random.uniform(-1, 1), random.uniform(-0.3, 0.3),
                                     random.uniform(0.8, 1.4));
            points.push_back(at.cast<float>());
        }
        std::map<std::array<int, 3>, float> nearest_m;
        for (const Eigen::Vector3f& point : points) {
            const Eigen::Array3f cube = ((point - kOrigin).array() / kEdge_m).floor();
            const float range_m = (point - kOrigin).norm();
            const auto [it, is_new] =
                nearest_m.insert({{int(cube.x()), int(cube.y()), int(cube.z())}, range_m});
            if (!is_new) it->second = std::min(it->second, range_m);
        }
        std::vector<float> expected, kept;
        for (const auto& [cube, range_m] : nearest_m) expected.push_back(range_m);
        const auto model = makeWorldModel("W-Full", setting());
        model->update(scanOf(twice(points)));
        for (const Eigen::Vector3f& point : model->obstacles().centre_m) {
            EXPECT_TRUE(std::find(points.begin(), points.end(), point) != points.end());
            kept.push_back((point - kOrigin).norm());
        }
        std::sort(expected.begin(), expected.end());
        std::sort(kept.begin(), kept.end());
        EXPECT_EQ(expected, kept);
        for (int i = 0; i < 50; ++i) {
            const Eigen::Vector3f at = sparsePoints(random, 1)[0];
            const float truth_m = nearestOf(points, at);
            EXPECT_GE(model->clearance_m(at), truth_m - 1e-5f);
            EXPECT_LE(model->clearance_m(at), truth_m + kEdge_m * std::sqrt(3.0f));
        }
    }
}

/// Compares with brute force as scans enter and leave the window.
TEST(WorldModel, WindowHidesIsolatedPoints) {
    struct Point {
        Eigen::Vector3f at;
        int scan;
        bool is_isolated;
    };
    simulation::Random random(31);
    const auto model = makeWorldModel("W-Full", setting());
    std::vector<Point> window;
    std::size_t isolated = 0, confirmed = 0;
    for (int scan = 0; scan < 60; ++scan) {
        std::vector<Eigen::Vector3f> points;
        for (int i = 0; i < 5; ++i) {  // each point in its own cube
            const auto cube = static_cast<float>(i) + 31;
            const auto y = static_cast<float>(random.uniform(-0.6, 0.6));
            const auto z = static_cast<float>(random.uniform(1.0, 1.6));
            points.emplace_back(0.1f * (cube + 0.5f), y, z);
        }
        window.erase(std::remove_if(window.begin(), window.end(),
                                    [&](const Point& p) { return p.scan <= scan - 11; }),
                     window.end());
        for (const auto& at : points) window.push_back({at, scan, true});
        const std::vector<Point> all = window;
        for (Point& p : window) {
            const float radius_m = std::max(0.15f, 0.05f * (p.at - kOrigin).norm());
            for (const Point& other : all) {
                const bool is_itself = other.scan == p.scan && other.at == p.at;
                const bool is_new = other.scan == scan || p.scan == scan;
                if (is_new && !is_itself && (other.at - p.at).norm() < radius_m) {
                    p.is_isolated = false;
                }
            }
        }
        model->update(scanOf(points));
        const auto kept = model->obstacles().centre_m;
        for (const Point& p : window) {
            const bool counts = std::find(kept.begin(), kept.end(), p.at) != kept.end();
            EXPECT_EQ(!p.is_isolated, counts) << scan;
            ++(p.is_isolated ? isolated : confirmed);
        }
    }
    EXPECT_GT(isolated, 100u);
    EXPECT_GT(confirmed, 100u);
}

/// Updates with whole scans, or five times per turn.
TEST(WorldModel, WindowForgetsAfterElevenTurns) {
    for (const std::string name : {"W-RoI", "W-Full"}) {
        for (const int per_turn : {1, 5}) {
            const auto model = makeWorldModel(name, setting());
            const auto updateWith = [&](const std::vector<Eigen::Vector3f>& points) {
                observations::MappedScan scan = scanOf(points);
                scan.turns = 1.0 / per_turn;
                model->update(scan);
            };
            updateWith(wall());
            for (int i = 1; i < 11 * per_turn; ++i) updateWith({{-4, 0, 1}});
            EXPECT_NEAR(1.1f, model->clearance_m({4, 0.1f, 1.1f}), 0.05f);
            updateWith({{-4, 0, 1}});
            EXPECT_EQ(WorldModel::kReach_m, model->clearance_m({4, 0.1f, 1.1f}));
            EXPECT_EQ(11u * per_turn, model->obstacles().centre_m.size());
        }
    }
}

TEST(WorldModel, RaysClearMovedObstacles) {
    for (const std::string name : {"O-Full-0.2", "O-RoI+rays-0.2", "O-RoI+rays-0.4", "G-Full",
                                   "R-Full-0.1", "R-Full-0.2", "D-Full"}) {
        const bool takes_passing_rays = name[0] == 'G' || name[0] == 'R';
        for (const bool only_passes : {false, true}) {
            if (only_passes && !takes_passing_rays) continue;
            const auto model = makeWorldModel(name, setting());
            for (int i = 0; i < 2; ++i) model->update(scanOf(board()));
            ASSERT_LT(model->clearance_m({2.1f, 0.1f, 1.1f}), 1.1f) << name;
            observations::MappedScan scan = scanOf(wall(7.1f), Label::Rou);
            if (only_passes) {
                scan = scanOf({});
                scan.passed_to_m = wall(7.1f);
            }
            for (int i = 0; i < 12; ++i) model->update(scan);
            EXPECT_GT(model->clearance_m({2.1f, 0.1f, 1.1f}), 2.0f) << name;
            if (only_passes) {
                EXPECT_GT(model->clearance_m({6.9f, 0.1f, 1.1f}), 1.0f) << name;
            }
        }
    }
}

// The wall at x = 5.1 m is 8 m wide.
TEST(SeenDirections, FreePlacesHaveFartherReturns) {
    using Place = SeenDirections::Place;
    const View view = viewOf(scanOf(wall()));
    const auto placeAt = [&](float x_m, float y_m) {
        return view.seen.placeAt(Eigen::Vector3f(x_m, y_m, 1.1f) - view.origin_m);
    };
    EXPECT_EQ(placeAt(2, 0.1f), Place::Free);
    EXPECT_EQ(placeAt(4.4f, 0.1f), Place::Free);
    EXPECT_EQ(placeAt(4.7f, 0.1f), Place::NotFree);
    EXPECT_EQ(placeAt(5.4f, 0.1f), Place::NotFree);
    EXPECT_EQ(placeAt(-2, 0.1f), Place::Unknown);
    EXPECT_EQ(placeAt(2, 4), Place::Unknown) << "beside the wall";
    // A pole is in front of the wall: rays close to the pole may have passed it.
    auto points = wall();
    for (float z = 0; z < 2; z += 0.05f) points.emplace_back(3, 0.2f, z);
    const View past_pole = viewOf(scanOf(points));
    EXPECT_EQ(past_pole.seen.placeAt(Eigen::Vector3f(2.8f, 0.25f, 1.1f) - kOrigin), Place::NotFree);
    EXPECT_EQ(past_pole.seen.placeAt(Eigen::Vector3f(2.8f, 0.7f, 1.1f) - kOrigin), Place::Free);
}

TEST(WorldModel, WindowReachesFifteenMetres) {
    const auto model = makeWorldModel("W-Full", setting());
    model->update(scanOf(twice({{14.9f, 0, 1}, {0, 15.2f, 1}})));
    EXPECT_NEAR(1, model->clearance_m({13.9f, 0, 1}), 1e-4);
    EXPECT_EQ(WorldModel::kReach_m, model->clearance_m({0, 14.2f, 1}));
}

TEST(WorldModel, ObstaclesHaveNoClearance) {
    for (const std::string& name : modelsThatLearn()) {
        const auto model = makeWorldModel(name, setting());
        model->update(scanOf(wall()));
        const auto obstacles = model->obstacles();
        EXPECT_EQ(edgeOf(name), obstacles.edge_m) << name;
        ASSERT_FALSE(obstacles.centre_m.empty()) << name;
        for (const auto& middle : obstacles.centre_m) {
            EXPECT_NEAR(5.1f, middle.x(), edgeOf(name)) << name;
            EXPECT_EQ(0, model->clearance_m(middle)) << name;
        }
    }
}

std::size_t heap() { return mallinfo2().uordblks + mallinfo2().hblkhd; }

TEST(WorldModel, BytesMatchHeap) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer's heap does not report its size";
#endif
    for (const std::string& name : modelsThatLearn()) {
        simulation::Random random(5);
        const auto first = makeWorldModel(name, setting());
        first->update(scanOf(sparsePoints(random, 3000)));  // allocates memory shared by all models
        const std::size_t before = heap();
        const auto model = makeWorldModel(name, setting());
        for (int i = 0; i < 12; ++i) model->update(scanOf(sparsePoints(random, 3000)));
        const auto measured = static_cast<double>(heap() - before);
        const auto reported = static_cast<double>(model->bytes());
        // malloc doubles the size of an octree's small nodes.
        EXPECT_GT(reported, 0.35 * measured) << name << " " << measured;
        EXPECT_LT(reported, 1.5 * measured) << name << " " << measured;
    }
}

TEST(WorldModel, OraclesReturnTrueClearance) {
    const auto model = makeWorldModel("oracle", setting());
    EXPECT_FLOAT_EQ(1.5f, model->clearance_m({3.5f, 0, 0}));
    EXPECT_EQ(WorldModel::kReach_m, model->clearance_m({-20, 0, 0}));
    EXPECT_TRUE(model->isKnown({-20, 0, 0}));
    EXPECT_EQ(0u, model->bytes());
    EXPECT_THROW(makeWorldModel("oracle", {kBounds, nullptr, {}}), std::invalid_argument);
    EXPECT_FLOAT_EQ(1.5f, model->clearanceAfter_m({3.5f, 0, 0}, 1)) << "assumes a static world";
    EXPECT_EQ(0, model->fastest_m_s());
    // The wall at x = 5 m approaches at 1 m/s.
    const auto predicts = makeWorldModel("oracle+motion", setting());
    EXPECT_FLOAT_EQ(1.5f, predicts->clearanceAfter_m({3.5f, 0, 0}, 0));
    EXPECT_FLOAT_EQ(0.5f, predicts->clearanceAfter_m({3.5f, 0, 0}, 1));
    EXPECT_GE(predicts->fastest_m_s(), 1);
}

TEST(WorldModel, OnlyMotionModelsPredictMotion) {
    for (const std::string& name : worldModelNames()) {
        const bool has_motion = name.find("+motion") != std::string::npos;
        EXPECT_EQ(predictsMotion(name), has_motion) << name;
    }
    EXPECT_FALSE(predictsMotion("X+motion"));
    EXPECT_FALSE(needsTruth("X"));
}

TEST(WorldModel, RejectsUnknownNames) {
    for (const std::string bad : {"", "w-roi", "O-Full", "W-RoI "}) {
        EXPECT_THROW(needsLabels(bad), std::invalid_argument);
        EXPECT_THAT(test::messageOf<std::invalid_argument>([&] { makeWorldModel(bad, setting()); }),
                    HasSubstr("O-RoI+rays-0.4"));
    }
}

TEST(WorldModel, AcceptsDisplayNames) {
    EXPECT_EQ(displayName("W-RoI"), "RoI window");
    EXPECT_EQ(displayName("O-RoI+rays-0.4"), "RoI OctoMap with all rays 0.4 m");
    EXPECT_EQ(displayName("X-Ray"), "X-Ray");
    std::set<std::string> spelled;
    for (const std::string& name : worldModelNames()) {
        const std::string shown = displayName(name);
        EXPECT_TRUE(spelled.insert(shown).second) << shown;
        EXPECT_EQ(worldModelFrom(name), name);
        EXPECT_EQ(worldModelFrom(shown), name);
        EXPECT_THAT(worldModelList(), HasSubstr(name + " (" + shown + ")"));
        EXPECT_THROW(needsLabels(shown), std::invalid_argument);  // display names are not keys
    }
    EXPECT_EQ(worldModelFrom("Full window"), "W-Full");
    EXPECT_EQ(worldModelFrom("OctoMap"), "OctoMap");
}

/// MRPT's grid rounds its size, and floats become too coarse for its cells.
TEST(GridAtFarPlaces, RejectsBoundsBeyondFloatPrecision) {
    for (const float far_m : {1e3F, 5e4F, 1.9e5F}) {
        const Eigen::Vector3f there(far_m, -far_m, 0);
        auto far = setting();
        far.bounds_m = {kBounds.min() + there, kBounds.max() + there};
        const auto model = makeWorldModel("G-Full", far);
        auto scan = scanOf({Eigen::Vector3f(5, 0, 1) + there});
        scan.origin_m += there;
        model->update(scan);
        EXPECT_EQ(model->obstacles().centre_m.size(), 1u) << far_m;
        EXPECT_LT(model->clearance_m(Eigen::Vector3f(4, 0, 1) + there), 1.3F) << far_m;
    }
    auto far = setting();
    far.bounds_m.max().x() = 5e6F;
    far.bounds_m.min().x() = 5e6F - 10;
    EXPECT_THROW(makeWorldModel("G-Full", far), std::runtime_error);
}

}  // namespace
}  // namespace hagen::avoidance
