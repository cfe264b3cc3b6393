// rawlog-segment --octomap.
#include <octomap/OcTree.h>

#include <cmath>
#include <set>

#include "support/SegmentTest.h"

namespace hagen {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;

class RawlogSegmentOctomap : public test::SegmentTest {
 protected:
    /// A map of the recording, created with these flags.
    octomap::OcTree mapOf(const std::vector<std::string>& flags) {
        const auto outcome = expectSuccess(
            with({"-i", recording(), "--octomap", path("map.bt"), "--overwrite"}, flags));
        EXPECT_EQ(outcome.err, "");
        EXPECT_THAT(outcome.out, HasSubstr("in the OctoMap: 10 of 10 scans"));
        octomap::OcTree tree(0.1);
        EXPECT_TRUE(tree.readBinary(path("map.bt")));
        return tree;
    }
};

std::vector<octomap::point3d> occupiedOf(const octomap::OcTree& tree) {
    octomap::OcTree leaves(tree);
    leaves.expand();
    std::vector<octomap::point3d> middles;
    for (auto leaf = leaves.begin_leafs(); leaf != leaves.end_leafs(); ++leaf) {
        if (leaves.isNodeOccupied(*leaf)) middles.push_back(leaf.getCoordinate());
    }
    return middles;
}

/// Distance to the axis of the nearest pole of the recording
/// (tests/support/make_poles_and_wall.cpp).
double distanceToPole(const octomap::point3d& p) {
    double min = 1e9;
    for (int i = -3; i <= 4; ++i) {
        min = std::min(min, std::hypot(p.x() - 5.0 * i, p.y() - 6.0));
        min = std::min(min, std::hypot(p.x() - (5.0 * i + 2.5), p.y() + 7.0));
    }
    return min;
}

bool isAtWall(const octomap::point3d& p) {
    return p.x() > 15.8 && p.x() < 16.7 && p.y() > -2.3 && p.y() < 3.3 && p.z() < 4.3;
}

TEST_F(RawlogSegmentOctomap, ObstaclesAreAtTruePositions) {
    const octomap::OcTree tree = mapOf({});
    EXPECT_EQ(tree.getResolution(), 0.2);
    std::set<int> poles;
    std::set<int> wall;  // y of the wall's voxels
    for (const octomap::point3d& p : occupiedOf(tree)) {
        // Some ground near a pole's foot is labelled RoI.
        const double reach_m = p.z() < 0.2f ? 0.8 : 0.35;
        EXPECT_TRUE(distanceToPole(p) < reach_m || isAtWall(p))
            << p.x() << " " << p.y() << " " << p.z();
        EXPECT_GT(p.z(), -0.15);
        if (isAtWall(p)) {
            wall.insert(static_cast<int>(std::floor(p.y() / 0.2f)));
        } else if (std::abs(p.x()) < 12) {
            poles.insert(static_cast<int>(std::lround(p.x() / 2.5f)));
        }
    }
    EXPECT_NEAR(static_cast<double>(wall.size()), 26, 1);  // 5 m in voxels of 0.2 m
    EXPECT_EQ(poles.size(), 9u);                           // on both sides, within 12 m
    for (double x = 0.1; x < 9; x += 0.2) {
        const auto* ahead = tree.search(x, 0.1, 1.1);
        ASSERT_TRUE(ahead) << x;
        EXPECT_FALSE(tree.isNodeOccupied(ahead)) << x;
    }
    EXPECT_FALSE(tree.search(17.5, 0.1, 1.1)) << "behind the wall";
}

TEST_F(RawlogSegmentOctomap, StoresRequestedContent) {
    const octomap::OcTree roi = mapOf({"--octomap-content", "roi"});
    const octomap::OcTree rays = mapOf({"--octomap-content", "roi+rays"});
    const octomap::OcTree full = mapOf({"--octomap-content", "full"});
    // Ground is occupied only if all returns are hits.
    const auto groundOf = [](const octomap::OcTree& tree) {
        int count = 0;
        for (const octomap::point3d& p : occupiedOf(tree))
            count += p.z() < 0.2 && !isAtWall(p) && distanceToPole(p) > 1;
        return count;
    };
    EXPECT_EQ(groundOf(roi), 0);
    EXPECT_EQ(groundOf(rays), 0);
    EXPECT_GT(groundOf(full), 1000);
    EXPECT_LT(roi.size(), rays.size() / 2);
}

TEST_F(RawlogSegmentOctomap, OmitsScansWithoutUsablePose) {
    std::string half, far;  // poses for the first 0.5 s only; one pose outside any map
    for (int i = 0; i < 10; ++i) {
        const std::string time = std::to_string(1767225600 + 0.1 * i);
        if (i <= 5) half += time + " " + std::to_string(0.3 * i) + " 0 1.2 0 0 0 1\n";
        far += time + (i == 7 ? " 1e9" : " 0") + " 0 1.2 0 0 0 1\n";
    }
    const auto partial = expectSuccess({"-i", recording(), "--octomap", path("half.bt"), "--poses",
                                        folder_.write("half.tum", half)});
    EXPECT_THAT(partial.out, HasSubstr("in the OctoMap: 6 of 10 scans"));
    EXPECT_THAT(partial.err, HasSubstr("not inserted into the map"));
    const auto outcome =
        expectSuccess({"-i", recording(), "--octomap", path("far.bt"), "-o", path("out.rawlog"),
                       "--poses", folder_.write("far.tum", far)});
    // The far pose also displaces the preceding scan.
    EXPECT_THAT(outcome.out, HasSubstr("in the OctoMap: 8 of 10 scans"));
    EXPECT_THAT(outcome.out, HasSubstr("10 LiDAR scans"));
    EXPECT_THAT(outcome.err, HasSubstr("lies outside an OctoMap"));
    EXPECT_THAT(outcome.err, HasSubstr("not inserted into the map"));
    EXPECT_TRUE(fs::exists(path("out.rawlog")));
}

TEST_F(RawlogSegmentOctomap, RejectsInvalidArguments) {
    const std::string map = path("map.bt");
    const Arguments log{"-i", recording()};
    for (const std::string bad : {"0", "-0.2", "nan", "inf", "fine"}) {
        expectFailure(with(log, {"--octomap", map, "--octomap-resolution", bad}), 2,
                      "--octomap-resolution");
    }
    expectFailures(log, 2,
                   {{{"--octomap", path("map.pcd")}, ".3Dscene"},
                    {{"--octomap", ""}, "--octomap"},
                    {{"--octomap", map, "--octomap-content", "all"},
                     "--octomap-content: 'all' is not one of full, roi, roi+rays\n"},
                    {{"-o", path("x"), "--octomap-content", "roi"}, "--octomap"}});
    folder_.write("map.bt", "mine");
    const std::string tum = folder_.write("old.tum", "1000 0 0 1 0 0 0 1\n1000.1 0 0 1 0 0 0 1\n");
    expectFailures(log, 1,
                   {{{"--octomap", map}, "--overwrite"},
                    {{"--octomap", "/proc/self/map.bt"}, "/proc/self/map.bt"},
                    {{"-q", "--octomap", path("b.bt"), "--poses", tum}, "from another clock"}});
    EXPECT_EQ(test::readFile(map), "mine");
    if (test::realScan().empty()) GTEST_SKIP() << "mrpt-common is not installed";
    expectFailure({"-i", test::realScan(), "--octomap", path("b.bt")}, 1, "--poses FILE.tum");
}

}  // namespace
}  // namespace hagen
