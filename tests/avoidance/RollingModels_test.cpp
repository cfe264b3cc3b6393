// Maps in a box that moves with the vehicle: the rolling grid and the depth-image map.
#include <gtest/gtest.h>
#include <hagen/avoidance/WorldModel.h>
#include <hagen/mrpt/ScanMap.h>
#include <hagen/simulation/Random.h>

#include <cmath>

namespace hagen::avoidance {
namespace {

const std::vector<std::string> kNames{"R-Full-0.1", "R-Full-0.2", "D-Full"};
// Half the box at 4 m/s. A box may be kMore_m larger, as it consists of whole voxel groups.
const Eigen::Array3f kReach_m(15, 15, 6);
constexpr float kMore_m = 4;

float rollingEdgeOf(const std::string& name) { return name == "R-Full-0.1" ? 0.1f : 0.2f; }

std::unique_ptr<WorldModel> make(const std::string& name, const FlightPace& pace = {}) {
    return makeWorldModel(name, {{}, nullptr, pace, ModelDistance::AsStored});
}

observations::MappedScan scanOf(const Eigen::Vector3f& origin,
                                const std::vector<Eigen::Vector3f>& points) {
    return {0, origin, points, std::vector<Label>(points.size(), Label::Rou), {}, {}};
}

Eigen::Vector3f randomIn(simulation::Random& random, const Eigen::Vector3f& middle, float around,
                         float up) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
    return middle + Eigen::Vector3d(around * x, around * y, up * z).cast<float>();
}

std::vector<Eigen::Vector3f> randomPoints(simulation::Random& random, const Eigen::Vector3f& middle,
                                          int count, float around = 17, float up = 5) {
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < count; ++i) points.push_back(randomIn(random, middle, around, up));
    return points;
}

/// Distance to the nearest voxel face, by brute force.
float bruteForce(const WorldModel::Obstacles& voxels, const Eigen::Vector3f& at) {
    float min = WorldModel::kReach_m;
    for (const Eigen::Vector3f& centre : voxels.centre_m) {
        const Eigen::Array3f beyond =
            ((at - centre).array().abs() - voxels.edge_m / 2).max(Eigen::Array3f::Zero());
        min = std::min(min, beyond.matrix().norm());
    }
    return min;
}

TEST(RollingModels, ClearanceMatchesVoxelsWhileMoving) {
    const std::vector<Eigen::Vector3f> steps{
        {0.3f, 0.1f, 0},       {0.5f, -0.7f, 0.2f}, {-3.1f, 5.3f, -2},  {7, 0, 0},
        {0, -13, 1},           {-21, -22, 9},       {0.1f, 0.1f, 0.1f}, {400, 0, 0},
        {-0.9f, -0.9f, -0.9f}, {1.7f, 2.9f, 0}};
    for (const std::string& name : kNames) {
        simulation::Random random(3);
        const auto model = make(name);
        Eigen::Vector3f origin(-7.03f, 2.05f, 1.07f);
        for (const Eigen::Vector3f& step : steps) {
            origin += step;
            auto points = randomPoints(random, origin, 250);
            const Eigen::Vector3f below = origin - Eigen::Vector3f(0, 0, 2);
            for (const auto& ground : randomPoints(random, below, 1500, 6, 0.1f)) {
                points.push_back(ground);
            }
            model->update(scanOf(origin, points));
            const auto voxels = model->obstacles();
            ASSERT_GT(voxels.centre_m.size(), 100u) << name;
            for (int i = 0; i < 400; ++i) {
                const Eigen::Vector3f at = randomIn(random, origin, 21, 11);  // partly outside
                const float expected = bruteForce(voxels, at);
                ASSERT_NEAR(model->clearance_m(at), expected, 1e-4f) << name << " " << i;
                ASSERT_NEAR(model->clearanceWithin_m(at, 0.9f), std::min(0.9f, expected), 1e-4f);
            }
        }
    }
}

/// Compares with an OctoMap, which has no box and stores floats.
TEST(RollingModels, GridMatchesOctoMap) {
    for (const std::string name : {"R-Full-0.1", "R-Full-0.2"}) {
        const float edge = rollingEdgeOf(name);
        simulation::Random random(4);
        observations::ScanMapOptions options;
        options.content = observations::MapContent::Full;
        options.resolution_m = edge;
        options.max_range_m = 15;
        observations::ScanMap map(options);
        const auto model = make(name);
        // The origin is chosen so that no ray passes exactly through a voxel edge.
        const Eigen::Vector3f origin(0.0317f, 0.0523f, 1.0713f);
        for (int scan = 0; scan < 12; ++scan) {
            // Some returns repeat at the same places, so that voxels are both hit and cleared.
            auto points = randomPoints(random, origin, 800, 4, 2);
            for (auto& point : points) {
                if (random.chance(0.3)) point = ((point.array() / 1.2f).round() * 1.2f + 0.05f);
                if (random.chance(0.1)) {  // beyond the range, but within the box's height
                    const Eigen::Vector3f ray =
                        (point - origin).cwiseProduct(Eigen::Vector3f(1, 1, 0.05f));
                    point = origin + 30 * ray.normalized();
                }
            }
            map.insert(scanOf(origin, points));
            model->update(scanOf(origin, points));
        }
        int known = 0, occupied = 0, other_known = 0, other_occupied = 0;
        std::vector<Eigen::Vector3f> cells;
        for (float x = -6 + edge / 2; x < 6; x += edge) {
            for (float y = -6 + edge / 2; y < 6; y += edge) {
                for (float z = -1 + edge / 2; z < 3; z += edge) {
                    const auto* node = map.tree().search(x, y, z);
                    const bool is_occupied = node && map.tree().isNodeOccupied(node);
                    known += node != nullptr;
                    occupied += is_occupied;
                    other_known += model->isKnown({x, y, z}) != (node != nullptr);
                    other_occupied += (model->clearance_m({x, y, z}) == 0) != is_occupied;
                }
            }
        }
        EXPECT_GT(known, 20000);
        EXPECT_GT(occupied, 700);
        EXPECT_LE(other_known, known / 1000) << name;
        EXPECT_LE(other_occupied, occupied / 1000) << name;
    }
}

TEST(RollingModels, ForgetsOnlyVoxelsOutsideBox) {
    for (const std::string& name : kNames) {
        simulation::Random random(5);
        const auto model = make(name);
        Eigen::Vector3f origin(3.3f, -8.1f, 2.2f);
        model->update(scanOf(origin, randomPoints(random, origin, 2000, 14, 4)));
        std::vector<Eigen::Vector3f> kept = model->obstacles().centre_m;
        for (int step = 0; step < 40; ++step) {
            origin = randomIn(random, origin, 2.0f, 0.7f);
            model->update(scanOf(origin, {}));
            const auto now = model->obstacles().centre_m;
            for (const auto& centre : kept) {
                const Eigen::Array3f away = (centre - origin).array().abs();
                if ((away <= kReach_m).all()) {
                    ASSERT_EQ(model->clearance_m(centre), 0) << name << " step " << step;
                    ASSERT_TRUE(model->isKnown(centre));
                }
                if ((away >= kReach_m + kMore_m).any()) {
                    ASSERT_FALSE(model->isKnown(centre)) << name << " step " << step;
                    ASSERT_GT(model->clearance_m(centre), 0);
                }
            }
            for (const auto& centre : now) {
                ASSERT_NE(std::find(kept.begin(), kept.end(), centre), kept.end())
                    << name << " step " << step << ": new voxel";
            }
            kept = now;
        }
        ASSERT_FALSE(kept.empty());
        model->update(scanOf(origin + Eigen::Vector3f(60, 0, 0), {}));
        model->update(scanOf(origin, {}));
        EXPECT_TRUE(model->obstacles().centre_m.empty()) << name << ": not cleared";
        EXPECT_FALSE(model->isKnown(kept[0]));
    }
}

TEST(RollingModels, MemoryStaysConstant) {
    for (const std::string& name : kNames) {
        simulation::Random random(6);
        const auto model = make(name);
        const auto offsets = randomPoints(random, Eigen::Vector3f::Zero(), 600);
        std::size_t bytes = 0;
        for (int step = 0; step < 60; ++step) {
            const Eigen::Vector3f origin(7.0f * static_cast<float>(step), -1, 2);
            auto points = offsets;
            for (auto& point : points) point += origin;
            model->update(scanOf(origin, points));
            if (step == 20) bytes = model->bytes();
        }
        EXPECT_LE(model->bytes(), bytes + bytes / 50) << name;
        EXPECT_GT(model->bytes(), 1000000u) << name;
    }
}

TEST(RollingModels, IgnoresReturnOrder) {
    for (const std::string& name : kNames) {
        simulation::Random random(7);
        const auto one = make(name), other = make(name);
        for (int step = 0; step < 6; ++step) {
            const Eigen::Vector3f origin(0.9f * static_cast<float>(step), 0, 1);
            auto points = randomPoints(random, origin, 1500, 9, 3);
            one->update(scanOf(origin, points));
            std::reverse(points.begin(), points.end());
            other->update(scanOf(origin, points));
            EXPECT_EQ(one->obstacles().centre_m, other->obstacles().centre_m) << name;
            for (int i = 0; i < 300; ++i) {
                const Eigen::Vector3f at = randomIn(random, origin, 10, 4);
                EXPECT_EQ(one->clearance_m(at), other->clearance_m(at)) << name;
                EXPECT_EQ(one->isKnown(at), other->isKnown(at)) << name;
            }
        }
    }
}

/// Faster flights require a larger range, even vertically.
TEST(RollingModels, BoxGrowsWithSpeed) {
    for (const std::string& name : kNames) {
        FlightPace pace;
        for (const double speed_m_s : {4.0, 10.0}) {
            pace.speed_m_s = speed_m_s;
            const auto model = make(name, pace);
            model->update(scanOf({0, 0, 0}, {{26, 0.05f, 0.05f}, {0.05f, 4, 8.5f}}));
            EXPECT_EQ(model->clearance_m({26, 0.05f, 0.05f}) == 0, speed_m_s == 10) << name;
            EXPECT_EQ(model->clearance_m({0.05f, 4, 8.5f}) == 0, speed_m_s == 10) << name;
        }
    }
}

/// Returns of walls around the sensor in 16 rows, like a VLP-16, with a pillar in front.
std::vector<Eigen::Vector3f> rows(const Eigen::Vector3f& origin, float pillar_m) {
    std::vector<Eigen::Vector3f> points;
    for (float elevation = -15; elevation <= 15; elevation += 2) {
        for (float azimuth = -179.9f; azimuth < 180; azimuth += 0.2f) {
            if (azimuth > 100) continue;  // no returns
            const float e = elevation * static_cast<float>(M_PI / 180);
            const float a = azimuth * static_cast<float>(M_PI / 180);
            const Eigen::Vector3f ray(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a),
                                      std::sin(e));
            const bool is_pillar = std::abs(azimuth) < 8;
            points.push_back(origin + ray * (is_pillar ? pillar_m : 12 + 2 * std::sin(3 * a)));
        }
    }
    return points;
}

/// Compares each voxel with the returns by angle.
TEST(DepthImageMap, KnownSpaceMatchesBruteForce) {
    constexpr float kEdge_m = 0.2f, kDegree = static_cast<float>(M_PI / 180);
    const Eigen::Vector3f origin(0.11f, -0.05f, 1.02f);
    const auto points = rows(origin, 5);
    const auto model = make("D-Full");
    model->update(scanOf(origin, points));
    std::vector<Eigen::Vector3f> directions;
    std::vector<float> ranges;
    for (const auto& point : points) {
        ranges.push_back((point - origin).norm());
        directions.push_back((point - origin) / ranges.back());
    }
    simulation::Random random(8);
    int known = 0, unknown = 0, must_be_known = 0;
    for (int i = 0; i < 4000; ++i) {
        const Eigen::Vector3f at = randomIn(random, origin, 15, 5);
        const Eigen::Vector3f voxel = ((at.array() / kEdge_m).floor() + 0.5f).matrix() * kEdge_m;
        if (model->clearance_m(voxel) == 0) continue;
        const float away = (voxel - origin).norm();
        const Eigen::Vector3f direction = (voxel - origin) / away;
        const float own = std::atan(0.5f * kEdge_m / away);  // the voxel's minimum half-angle
        // Half a row, plus pixels of up to two voxels or one degree.
        const float wide = std::max(6 * own, 3 * kDegree);
        bool is_hidden = false, has_return = false, has_beside = false, is_all_beyond = true;
        for (std::size_t k = 0; k < points.size(); ++k) {
            const float cosine = direction.dot(directions[k]);
            if (cosine < std::cos(wide)) continue;
            has_beside = true;
            is_all_beyond = is_all_beyond && ranges[k] > away + 0.19f;
            if (cosine < std::cos(0.7f * own)) continue;
            has_return = true;
            is_hidden = is_hidden || ranges[k] < away;
        }
        const bool is_known = model->isKnown(voxel);
        ++(is_known ? known : unknown);
        if (is_hidden || !has_beside) {
            ASSERT_FALSE(is_known) << voxel.transpose();
        } else if (has_return && is_all_beyond) {
            ++must_be_known;
            ASSERT_TRUE(is_known) << voxel.transpose();
        }
    }
    EXPECT_GT(known, 300);
    EXPECT_GT(unknown, 1000);
    EXPECT_GT(must_be_known, 80);
}

TEST(DepthImageMap, KnownSpaceStaysKnown) {
    const auto model = make("D-Full");
    const Eigen::Vector3f origin(0.11f, -0.05f, 1.02f);
    std::vector<Eigen::Vector3f> known;
    simulation::Random random(9);
    for (const float pillar_m : {5.0f, 8.0f, 3.0f, 5.0f}) {
        model->update(scanOf(origin, rows(origin, pillar_m)));
        for (const auto& at : known) ASSERT_TRUE(model->isKnown(at));
        for (int i = 0; i < 3000; ++i) {
            const Eigen::Vector3f at = randomIn(random, origin, 13, 3);
            if (model->isKnown(at)) known.push_back(at);
        }
    }
    EXPECT_GT(known.size(), 1000u);
}

/// Three images that see through a pillar remove only this pillar.
TEST(DepthImageMap, RemovesPillarSeenThrough) {
    const auto model = make("D-Full");
    const Eigen::Vector3f origin(0.11f, -0.05f, 1.02f), beside = origin + Eigen::Vector3f(4, 0, 0);
    model->update(scanOf(origin, rows(origin, 5)));
    const std::size_t all = model->obstacles().centre_m.size();
    ASSERT_NEAR(model->clearance_m(beside), 1, 0.25);
    for (int scan = 0; scan < 2; ++scan) model->update(scanOf(origin, rows(origin, 12)));
    EXPECT_NEAR(model->clearance_m(beside), 1, 0.25) << "two misses must not outweigh a hit";
    model->update(scanOf(origin, rows(origin, 12)));
    EXPECT_GT(model->clearance_m(beside), 2.5);
    EXPECT_GT(model->obstacles().centre_m.size(), all - all / 10);
}

/// A voxel with a return is not cleared, even if other rays pass through it.
TEST(DepthImageMap, KeepsVoxelWithReturn) {
    const auto model = make("D-Full");
    std::vector<Eigen::Vector3f> points;
    for (float y = -0.5f; y <= 0.5f; y += 0.01f) {
        for (float z = -0.5f; z <= 0.5f; z += 0.01f) points.emplace_back(10.0f, y, z);
    }
    const auto wall = points;
    points.emplace_back(0.801f, 0.199f, 0.199f);  // in a corner, beside the centre's pixels
    for (int scan = 0; scan < 10; ++scan) model->update(scanOf({0, 0, 0}, points));
    int scans = 0;
    for (; model->clearance_m({0.9f, 0.1f, 0.1f}) == 0 && scans < 50; ++scans) {
        model->update(scanOf({0, 0, 0}, wall));
    }
    EXPECT_EQ(scans, 9) << "from the maximum log odds";
}

}  // namespace
}  // namespace hagen::avoidance
