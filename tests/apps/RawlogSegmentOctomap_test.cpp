// rawlog-segment --octomap, as a user would run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <set>

#include "support/ProgramTest.h"

namespace hagen {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;
const fs::path kRecording = fs::path(HAGEN_SOURCE_DIR) / "rawlogs/poles_and_wall.rawlog";

class RawlogSegmentOctomap : public test::ProgramTest {
 protected:
    test::Outcome run(const std::vector<std::string>& arguments) const override {
        return test::run(HAGEN_RAWLOG_SEGMENT, arguments);
    }

    /// A map of the recording, created with these flags.
    octomap::OcTree mapOf(const std::vector<std::string>& flags) {
        std::vector<std::string> arguments = {"-i", kRecording, "--octomap", path("map.bt"),
                                              "--overwrite"};
        arguments.insert(arguments.end(), flags.begin(), flags.end());
        const auto outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
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

/// Distance to the axis of the nearest pole of the recording (tests/support/PolesAndWall.cpp).
double distanceToPole(const octomap::point3d& p) {
    double least = 1e9;
    for (int i = -3; i <= 4; ++i) {
        least = std::min(least, std::hypot(p.x() - 5.0 * i, p.y() - 6.0));
        least = std::min(least, std::hypot(p.x() - (5.0 * i + 2.5), p.y() + 7.0));
    }
    return least;
}

bool isAtWall(const octomap::point3d& p) {
    return p.x() > 15.8 && p.x() < 16.7 && p.y() > -2.3 && p.y() < 3.3 && p.z() < 4.3;
}

TEST_F(RawlogSegmentOctomap, ObstaclesAreWhereTheyAreKnownToBe) {
    const octomap::OcTree tree = mapOf({});
    EXPECT_EQ(tree.getResolution(), 0.2);
    std::set<int> poles;
    std::set<int> wall;  // by y
    for (const octomap::point3d& p : occupiedOf(tree)) {
        // Some ground around a pole's foot is RoI.
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

TEST_F(RawlogSegmentOctomap, ContentSaysWhatGoesIn) {
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

TEST_F(RawlogSegmentOctomap, ResolutionIsTheVoxelsEdge) {
    EXPECT_EQ(mapOf({"--octomap-resolution", "0.5"}).getResolution(), 0.5);
}

TEST_F(RawlogSegmentOctomap, TheSameBytesInEveryFormatWithAnyNumberOfThreads) {
    for (const std::string name : {"a", "b"}) {
        ASSERT_EQ(run({"-q", "-i", kRecording, "--octomap", path(name + ".bt"), "--octomap",
                       path(name + ".ot"), "--octomap", path(name + ".3Dscene"), "--jobs",
                       name == "a" ? "1" : "3"})
                      .exit_code,
                  0);
    }
    for (const std::string ending : {".bt", ".ot", ".3Dscene"}) {
        EXPECT_EQ(test::readFile(path("a" + ending)), test::readFile(path("b" + ending)));
    }
}

TEST_F(RawlogSegmentOctomap, AScanFolderWithPosesGivesTheSameObstacles) {
    ASSERT_EQ(run({"-i", kRecording, "--kitti", path("scans")}).exit_code, 0);
    const octomap::OcTree of_log = mapOf({});
    ASSERT_EQ(run({"-i", path("scans"), "--octomap", path("of_folder.bt")}).exit_code, 0);
    octomap::OcTree of_folder(0.1);
    ASSERT_TRUE(of_folder.readBinary(path("of_folder.bt")));
    // Its returns have no times, so each scan is placed with one pose: errors of up to 0.3 m.
    for (const octomap::point3d& p : occupiedOf(of_folder)) {
        EXPECT_TRUE(distanceToPole(p) < 0.65 || p.x() > 15.4) << p.x() << " " << p.y();
    }
    EXPECT_NEAR(static_cast<double>(occupiedOf(of_folder).size()),
                static_cast<double>(occupiedOf(of_log).size()),
                0.4 * static_cast<double>(occupiedOf(of_log).size()));
}

TEST_F(RawlogSegmentOctomap, ScansWithoutAPoseAreLeftOutAndNamed) {
    // Poses for the first half second only.
    std::string tum;
    for (int i = 0; i <= 5; ++i) {
        tum += std::to_string(1767225600 + 0.1 * i) + " " + std::to_string(0.3 * i) +
               " 0 1.2 0 0 0 1\n";
    }
    const auto outcome = run(
        {"-i", kRecording, "--octomap", path("map.bt"), "--poses", folder_.write("half.tum", tum)});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("in the OctoMap: 6 of 10 scans"));
    EXPECT_THAT(outcome.err, HasSubstr("it is not in the map"));
}

TEST_F(RawlogSegmentOctomap, APoseThatNoMapCanHoldCostsOnlyTheScansThatUseIt) {
    std::string tum;
    for (int i = 0; i < 10; ++i) {
        tum += std::to_string(1767225600 + 0.1 * i) + (i == 7 ? " 1e9" : " 0") + " 0 1.2 0 0 0 1\n";
    }
    const auto outcome = run({"-i", kRecording, "--octomap", path("map.bt"), "-o",
                              path("out.rawlog"), "--poses", folder_.write("far.tum", tum)});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out,
                HasSubstr("in the OctoMap: 8 of 10 scans"));  // its own, and the one before, which
                                                              // moves towards it
    EXPECT_THAT(outcome.out, HasSubstr("10 LiDAR scans"));
    EXPECT_THAT(outcome.err, HasSubstr("lies outside an OctoMap"));
    EXPECT_THAT(outcome.err, HasSubstr("it is not in the map"));
    EXPECT_TRUE(fs::exists(path("out.rawlog")));
}

TEST_F(RawlogSegmentOctomap, FailsWithoutPoses) {
    if (test::realScan().empty()) GTEST_SKIP() << "mrpt-common is not installed";
    expectFailure({"-i", test::realScan(), "--octomap", path("map.bt"), "-o", path("out.rawlog")},
                  1, "--poses FILE.tum");
}

TEST_F(RawlogSegmentOctomap, FailsWherePosesAreOfAnotherClock) {
    const std::string tum = folder_.write("old.tum", "1000 0 0 1 0 0 0 1\n1000.1 0 0 1 0 0 0 1\n");
    expectFailure({"-q", "-i", kRecording, "--octomap", path("map.bt"), "--poses", tum}, 1,
                  "from another clock");
}

TEST_F(RawlogSegmentOctomap, RefusesWrongUsage) {
    const std::string map = path("map.bt");
    for (const std::string bad : {"0", "-0.2", "nan", "inf", "fine"}) {
        expectFailure({"-i", kRecording, "--octomap", map, "--octomap-resolution", bad}, 2,
                      "--octomap-resolution");
    }
    expectFailure({"-i", kRecording, "--octomap", path("map.pcd")}, 2, ".3Dscene");
    expectFailure({"-i", kRecording, "--octomap", ""}, 2, "--octomap");
    expectFailure({"-i", kRecording, "--octomap", map, "--octomap-content", "all"}, 2,
                  "--octomap-content: 'all' is not one of full, roi, roi+rays\n");
    expectFailure({"-i", kRecording, "-o", path("x"), "--octomap-content", "roi"}, 2, "--octomap");
}

TEST_F(RawlogSegmentOctomap, ReplacesNothingUnasked) {
    const std::string map = folder_.write("map.bt", "somebody's");
    expectFailure({"-i", kRecording, "--octomap", map}, 1, "--overwrite");
    expectFailure({"-i", kRecording, "--octomap", path("none/map.bt")}, 1, "none");
    EXPECT_EQ(test::readFile(map), "somebody's");
}

}  // namespace
}  // namespace hagen
