#include <gmock/gmock.h>
#include <hagen/mrpt/ScanMap.h>
#include <hagen/simulation/Random.h>

#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "support/Program.h"

namespace hagen::observations {
namespace {

using testing::HasSubstr;

using Voxel = std::tuple<int, int, int>;

Voxel voxelOf(const Eigen::Vector3d& p, double edge_m) {
    return {static_cast<int>(std::floor(p.x() / edge_m)),
            static_cast<int>(std::floor(p.y() / edge_m)),
            static_cast<int>(std::floor(p.z() / edge_m))};
}

Eigen::Vector3d middleOf(const Voxel& v, double edge_m) {
    return edge_m * (Eigen::Vector3d(std::get<0>(v), std::get<1>(v), std::get<2>(v)) +
                     Eigen::Vector3d::Constant(0.5));
}

/// Length of a segment within a voxel widened by a margin (slab method).
double lengthIn(const Voxel& v, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                double edge_m, double margin_m = 0) {
    double first = 0, last = 1;
    const Eigen::Vector3d middle = middleOf(v, edge_m);
    for (int i = 0; i < 3; ++i) {
        const double step = to[i] - from[i];
        double in = (middle[i] - edge_m / 2 - margin_m - from[i]) / step;
        double out = (middle[i] + edge_m / 2 + margin_m - from[i]) / step;
        if (in > out) std::swap(in, out);
        first = std::max(first, in);
        last = std::min(last, out);
    }
    return std::max(0.0, last - first) * (to - from).norm();
}

MappedScan mappedScanOf(const std::vector<Eigen::Vector3f>& points, Label label = Label::Roi,
                        const Eigen::Vector3f& origin = {0.03f, 0.05f, 0.07f}) {
    return {0, origin, points, std::vector<Label>(points.size(), label), {}, {}};
}

constexpr double kBarely_m = 1e-4;

enum class State { Unknown, Free, Occupied };

State stateAt(const ScanMap& map, const Eigen::Vector3d& p) {
    const auto* node = map.tree().search(p.x(), p.y(), p.z());
    if (!node) return State::Unknown;
    return map.tree().isNodeOccupied(node) ? State::Occupied : State::Free;
}

MappedScan randomScan(simulation::Random& random, int points) {
    MappedScan scan;
    scan.origin_m = {0.03f, 0.05f, 0.07f};
    for (int i = 0; i < points; ++i) {
        const double x = random.uniform(-3, 3);
        const double y = random.uniform(-3, 3);
        const double z = random.uniform(-2, 2);
        scan.points_m.push_back(Eigen::Vector3d(x, y, z).cast<float>());
        scan.labels.push_back(random.chance(0.5) ? Label::Roi : Label::Rou);
    }
    return scan;
}

/// Compares voxels near the scan with hits and rays. A voxel barely touched by a ray may have
/// either state.
void expectAsDefined(const ScanMapOptions& options, const MappedScan& scan) {
    ScanMap map(options);
    map.insert(scan);
    const double edge = options.resolution_m;
    const Eigen::Vector3d origin = scan.origin_m.cast<double>();
    std::set<Voxel> hits;
    std::vector<Eigen::Vector3d> ends;
    for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
        const Eigen::Vector3d point = scan.points_m[i].cast<double>();
        const double range = (point - origin).norm();
        const bool is_hit = options.content == MapContent::Full || scan.labels[i] == Label::Roi;
        if (is_hit && range <= options.max_range_m) hits.insert(voxelOf(point, edge));
        if (!is_hit && options.content != MapContent::RoiAndRays) continue;
        const Eigen::Vector3d end =
            range > options.max_range_m
                ? Eigen::Vector3d(origin + (point - origin) * (options.max_range_m / range))
                : point;
        ends.push_back(middleOf(voxelOf(end, edge), edge));
    }
    for (int x = -17; x < 17; ++x) {
        for (int y = -17; y < 17; ++y) {
            for (int z = -12; z < 12; ++z) {
                const Voxel voxel{x, y, z};
                const State state = stateAt(map, middleOf(voxel, edge));
                if (hits.count(voxel)) {
                    ASSERT_EQ(State::Occupied, state) << x << " " << y << " " << z;
                    const Eigen::Vector3d at = middleOf(voxel, edge);
                    ASSERT_EQ(map.tree().getProbHitLog(),
                              map.tree().search(at.x(), at.y(), at.z())->getLogOdds())
                        << "must be hit once and not cleared";
                    continue;
                }
                double longest = 0, longest_about = 0;
                for (const auto& end : ends) {
                    if (voxelOf(end, edge) == voxel) continue;
                    longest = std::max(longest, lengthIn(voxel, origin, end, edge));
                    longest_about =
                        std::max(longest_about, lengthIn(voxel, origin, end, edge, kBarely_m));
                }
                if (longest > kBarely_m) {
                    ASSERT_EQ(State::Free, state) << x << " " << y << " " << z;
                } else if (longest_about == 0) {
                    ASSERT_EQ(State::Unknown, state) << x << " " << y << " " << z;
                }
            }
        }
    }
}

TEST(ScanMap, MatchesBruteForce) {
    simulation::Random random(1);
    for (const MapContent content : {MapContent::Full, MapContent::Roi, MapContent::RoiAndRays}) {
        for (int i = 0; i < 2; ++i) {
            expectAsDefined({content, 0.2, 20}, randomScan(random, 40));
            expectAsDefined({content, 0.2, 1.5}, randomScan(random, 40));
        }
    }
}

TEST(ScanMap, ClearsUpToWall) {
    std::vector<Eigen::Vector3f> wall;
    for (float y = -2; y <= 2; y += 0.05f) {
        for (float z = -1; z <= 1; z += 0.05f) wall.emplace_back(5.1f, y, z);
    }
    ScanMap map({MapContent::Full, 0.2, 20});
    map.insert(mappedScanOf(wall));
    for (double y = -1.9; y < 2; y += 0.2) {
        EXPECT_EQ(State::Occupied, stateAt(map, {5.1, y, 0.1}));
        EXPECT_EQ(State::Free, stateAt(map, {4.9, y, 0.1}));
        EXPECT_EQ(State::Unknown, stateAt(map, {5.3, y, 0.1}));
    }
}

TEST(ScanMap, IgnoresNonFiniteReturns) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const float height_m : {0.0f, 50.0f, -50.0f}) {
        MappedScan scan = mappedScanOf({{kNan, 0, 0}, {kInfinity, 0, 0}, {0, 1e30f, -1e38f}});
        scan.origin_m = {0, 0, height_m};
        ScanMap map({MapContent::Full, 0.2, 20});
        map.insert(scan);
        EXPECT_EQ(map.tree().size(), 0u) << height_m;
    }
}

TEST(ScanMap, GroundRaysOnlyClear) {
    MappedScan scan = mappedScanOf({{5.1f, 0.1f, -1.9f}, {3.1f, 2.1f, 0.1f}});
    scan.labels[0] = Label::Rou;
    ScanMap map({MapContent::RoiAndRays, 0.2, 20});
    map.insert(scan);
    EXPECT_EQ(State::Unknown, stateAt(map, {5.1, 0.1, -1.9}));
    EXPECT_EQ(State::Free, stateAt(map, {2.57, 0.075, -0.915}));
    EXPECT_EQ(State::Occupied, stateAt(map, {3.1, 2.1, 0.1}));

    ScanMap of_roi({MapContent::Roi, 0.2, 20});
    of_roi.insert(scan);
    EXPECT_EQ(State::Unknown, stateAt(of_roi, {2.57, 0.075, -0.915}));
}

TEST(ScanMap, ClearsMovedObstacles) {
    ScanMap map({MapContent::RoiAndRays, 0.2, 20});
    map.insert(mappedScanOf({{3.1f, 0.1f, 0.1f}}));
    ASSERT_EQ(State::Occupied, stateAt(map, {3.1, 0.1, 0.1}));
    for (int i = 0; i < 5; ++i) map.insert(mappedScanOf({{9.1f, 0.1f, 0.1f}}, Label::Rou));
    EXPECT_EQ(State::Free, stateAt(map, {3.1, 0.1, 0.1}));
}

TEST(ScanMap, AcceptsEmptyScans) {
    ScanMap map({});
    map.insert({});
    EXPECT_EQ(0u, map.tree().size());
}

TEST(ScanMap, RejectsInvalidResolutionAndRange) {
    for (const double bad : {0.0, -0.2, double(NAN), double(INFINITY)}) {
        EXPECT_THROW(ScanMap({MapContent::Full, bad, 20}), std::invalid_argument) << bad;
        EXPECT_THROW(ScanMap({MapContent::Full, 0.2, bad}), std::invalid_argument) << bad;
    }
}

TEST(ScanMap, RejectsInconsistentProbabilities) {
    const auto make = [](double min, double miss, double hit, double greatest) {
        ScanMapOptions options;
        options.min_probability = min;
        options.miss_probability = miss;
        options.hit_probability = hit;
        options.greatest_probability = greatest;
        ScanMap map(options);
    };
    EXPECT_NO_THROW(make(0.1, 0.4, 0.7, 0.9));
    EXPECT_THROW(make(0, 0.4, 0.7, 0.9), std::invalid_argument);
    EXPECT_THROW(make(0.45, 0.4, 0.7, 0.9), std::invalid_argument);
    EXPECT_THROW(make(0.1, 0.6, 0.7, 0.9), std::invalid_argument);
    EXPECT_THROW(make(0.1, 0.4, 0.4, 0.9), std::invalid_argument);
    EXPECT_THROW(make(0.1, 0.4, 0.7, 1), std::invalid_argument);
    EXPECT_THROW(make(0.1, 0.4, std::nan(""), 0.9), std::invalid_argument);
    ScanMapOptions options;
    options.insertion = RayInsertion::OctoMap;
    EXPECT_THROW(ScanMap{options},
                 std::invalid_argument);  // the default is RoiAndRays
}

TEST(ScanMap, UsesGivenProbabilities) {
    ScanMapOptions options;
    options.content = MapContent::Full;
    options.hit_probability = 0.9;
    options.miss_probability = 0.3;
    options.min_probability = 0.25;
    options.greatest_probability = 0.95;
    ScanMap map(options);
    const auto at = [&](float x) { return map.tree().search(x, 0.1f, 0.1f)->getOccupancy(); };
    map.insert(mappedScanOf({{2.1f, 0.1f, 0.1f}}));
    EXPECT_NEAR(at(2.1f), 0.9, 1e-6);
    EXPECT_NEAR(at(1.1f), 0.3, 1e-6);
    map.insert(mappedScanOf({{2.1f, 0.1f, 0.1f}}));
    EXPECT_NEAR(at(2.1f), 0.95, 1e-6);
    EXPECT_NEAR(at(1.1f), 0.25, 1e-6);
}

/// OctoMap's own insertion serves as a reference.
TEST(ScanMap, MatchesOctoMapInsertion) {
    simulation::Random random(12);
    const MappedScan scan = randomScan(random, 400);
    ScanMapOptions options;
    options.content = MapContent::Full;
    ScanMap own(options);
    options.insertion = RayInsertion::OctoMap;
    ScanMap rays(options);
    options.insertion = RayInsertion::OctoMapDiscrete;
    ScanMap discrete(options);
    for (ScanMap* map : {&own, &rays, &discrete}) map->insert(scan);
    int free = 0, occupied = 0;
    for (double x = -3.1; x < 3.2; x += 0.2) {
        for (double y = -3.1; y < 3.2; y += 0.2) {
            for (double z = -2.1; z < 2.2; z += 0.2) {
                const State state = stateAt(own, {x, y, z});
                EXPECT_EQ(state, stateAt(discrete, {x, y, z}));
                const bool is_occupied = state == State::Occupied;  // OctoMap's rays end at points
                EXPECT_EQ(is_occupied, stateAt(rays, {x, y, z}) == State::Occupied);
                free += state == State::Free;
                occupied += is_occupied;
            }
        }
    }
    EXPECT_GT(free, 3000);
    EXPECT_GT(occupied, 300);
}

TEST(ScanMap, RejectsScansBeyondExtent) {
    for (const float far_m : {6600.0f, 500000.0f, -6600.0f}) {
        ScanMap map({MapContent::Full, 0.2, 20});
        MappedScan scan;
        scan.origin_m = {far_m, 0, 0};
        scan.points_m = {{far_m + 5, 0, 0}};
        scan.labels = {Label::Roi};
        EXPECT_THAT(test::messageOf([&] { map.insert(scan); }), HasSubstr("poses")) << far_m;
        EXPECT_EQ(map.tree().size(), 0u);
    }
}

}  // namespace
}  // namespace hagen::observations
