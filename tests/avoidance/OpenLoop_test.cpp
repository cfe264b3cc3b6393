#include <gmock/gmock.h>
#include <hagen/avoidance/OpenLoop.h>
#include <hagen/recordings/ScanFolder.h>
#include "recordings/PoseFile.h"

#include <algorithm>
#include <fstream>

#include "support/Program.h"
#include "support/SimpleScene.h"

namespace hagen::avoidance {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;
using mrpt::poses::CPose3D;

constexpr float kWall_m = 6;

/// A model that initially contains flat ground and a wall and counts its updates.
class WallModel : public WorldModel {
 public:
    struct Notes {
        std::vector<Eigen::AlignedBox3f> bounds_m;  ///< one per model
        std::vector<int> updates;
    };
    WallModel(const WorldModelSetting& setting, Notes& notes) : notes_(notes) {
        notes_.bounds_m.push_back(setting.bounds_m);
        notes_.updates.push_back(0);
    }
    void update(const observations::MappedScan&) override { ++notes_.updates.back(); }
    float clearance_m(const Eigen::Vector3f& point_m) const override {
        return std::clamp(std::min(kWall_m - point_m.x(), point_m.z()), 0.0f, kReach_m);
    }
    bool isKnown(const Eigen::Vector3f&) const override { return true; }
    std::size_t bytes() const override { return 7; }
    Obstacles obstacles() const override { return {{{kWall_m, 0, 0}}, 1}; }

 private:
    Notes& notes_;
};

class OpenLoopTest : public testing::Test {
 protected:
    /// A scan folder of a flight towards the wall x = 6 over flat ground.
    fs::path wallFlight(int scans, double step_m = 0.1, double period_s = 0.1,
                        int columns = 870) const {
        const test::SimpleScene scene = test::sceneOf({{{kWall_m, -60, 0}, {kWall_m + 1, 60, 20}}});
        const fs::path folder = folder_ / "flight";
        fs::create_directories(folder / "velodyne");
        std::vector<recordings::TimedPose> poses;
        std::ofstream times(folder / "times.txt");
        for (int i = 0; i < scans; ++i) {
            const double x_m = i * step_m;
            const auto labelled =
                test::scanScene(scene, sensorModel("VLP-16"), columns, {x_m, 0, 2});
            recordings::writeScan(folder / "velodyne" / (std::to_string(1000 + i) + ".bin"),
                                  labelled.scan);
            times << 100 + i * period_s << "\n";
            poses.push_back({100 + i * period_s, CPose3D(x_m, 0, 2, 0, 0, 0)});
        }
        recordings::writeTumPoses(folder / "poses.tum", poses);
        return folder;
    }
    OpenLoop openLoop(const fs::path& log, const std::vector<std::string>& models) const {
        OpenLoop open_loop;
        open_loop.source.log = log;
        open_loop.models = models;
        return open_loop;
    }
    /// Every model is a WallModel.
    OpenLoop wallsOnly(const fs::path& log) {
        OpenLoop open_loop = openLoop(log, {"W-Full"});
        open_loop.make = [this](const std::string&, const WorldModelSetting& setting) {
            return std::make_unique<WallModel>(setting, notes_);
        };
        return open_loop;
    }
    test::TemporaryFolder folder_;
    WallModel::Notes notes_;
};

TEST_F(OpenLoopTest, PerfectModelScoresPerfectly) {
    const auto result = runOpenLoop(wallsOnly(wallFlight(8)));
    EXPECT_EQ(result.scans, 8u);
    const OpenLoopModel& model = result.models.at(0);
    EXPECT_GT(model.all.hits, 500u);
    EXPECT_GT(model.level.scored, 500u);
    EXPECT_GE(model.level.precision(), 0.99);
    EXPECT_GE(model.level.recall(), 0.99);
    EXPECT_EQ(result.agreement, (std::vector<std::vector<double>>{{1}}));
    EXPECT_EQ(model.bytes, std::vector<double>(8, 7));
    EXPECT_EQ(model.obstacles, std::vector<double>(8, 1));
    EXPECT_EQ(result.scans_placed_by_one_pose, 8u);
}

TEST_F(OpenLoopTest, ModelsSeeWall) {
    const auto result = runOpenLoop(openLoop(wallFlight(8), {"W-RoI", "W-Full", "O-Full-0.4"}));
    for (const OpenLoopModel& model : result.models) {
        EXPECT_GE(model.level.recall(), 0.95) << model.name;
        EXPECT_GE(model.level.precision(), 0.8) << model.name;  // voxels are thicker than walls
        EXPECT_EQ(model.update_ms.size(), 8u);
    }
    EXPECT_GE(result.models[0].level.precision(), 0.98);
    EXPECT_GE(result.models[1].level.precision(), 0.98);
    // The ground, which blocks downward directions, is not RoI.
    EXPECT_LT(result.models[0].by_elevation[0].recall(), result.models[1].by_elevation[0].recall());
    EXPECT_LT(result.models[0].obstacles.back(), result.models[1].obstacles.back());
    EXPECT_EQ(result.agreement[0][1], result.agreement[1][0]);
    EXPECT_EQ(result.agreement[2][2], 1);
}

TEST_F(OpenLoopTest, RowsAddUpToTotals) {
    DirectionCounts sum;
    std::vector<std::size_t> scans;
    OpenLoopListener listener;
    listener.row = [&](const OpenLoopRow& row, const OpenLoopCost&) {
        EXPECT_EQ(row.all.hits + row.all.misses, row.truly_blocked);
        scans.push_back(row.scan);
        sum += row.all;
    };
    const auto result = runOpenLoop(wallsOnly(wallFlight(5)), listener);
    EXPECT_EQ(scans, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
    EXPECT_EQ(sum.hits, result.models[0].all.hits);
    EXPECT_EQ(sum.scored, result.models[0].all.scored);
}

TEST_F(OpenLoopTest, ShortFlightNeedsNoReset) {
    const auto result = runOpenLoop(wallsOnly(wallFlight(5)));
    EXPECT_EQ(result.model_resets, 0u);
    EXPECT_EQ(notes_.bounds_m.size(), 1u);
    EXPECT_EQ(notes_.updates, std::vector<int>{5});
    EXPECT_TRUE(notes_.bounds_m[0].contains(Eigen::Vector3f(-19.9f, 19.9f, 11.9f)));
}

TEST_F(OpenLoopTest, LongFlightResetsMaps) {
    // Flies away from the wall at 10 m/s.
    const auto result = runOpenLoop(wallsOnly(wallFlight(25, -10, 1, 90)));
    EXPECT_GE(result.model_resets, 10u);
    ASSERT_EQ(notes_.bounds_m.size(), result.model_resets + 1);
    Eigen::AlignedBox3f all;
    for (const auto& box : notes_.bounds_m) {
        EXPECT_NEAR(box.sizes().x(), 60, 1e-3);
        all.extend(box);
    }
    EXPECT_TRUE(all.contains(Eigen::Vector3f(-250, 0, 2)));
    // 2 or 3 scans each, plus the scans of the previous 3 s.
    for (const int updates : notes_.updates) EXPECT_LE(updates, 3 + 4);
    EXPECT_GE(notes_.updates.at(3), 3 + 2);
}

TEST_F(OpenLoopTest, RejectsInvalidRequests) {
    const fs::path log = folder_ / "none";
    EXPECT_THROW(runOpenLoop(openLoop(log, {})), std::invalid_argument);
    EXPECT_THROW(runOpenLoop(openLoop(log, {"W-Roy"})), std::invalid_argument);
    EXPECT_THROW(runOpenLoop(openLoop(log, {"O-Full-0"})), std::invalid_argument);
    EXPECT_THROW(runOpenLoop(openLoop(log, {"W-RoI", "W-RoI"})), std::invalid_argument);
    EXPECT_THROW(runOpenLoop(openLoop(log, {"oracle"})), std::invalid_argument);
    OpenLoop jungle = openLoop(log, {"oracle"});
    jungle.scene = {"jungle", 1};
    EXPECT_THROW(runOpenLoop(jungle), std::invalid_argument);
}

TEST_F(OpenLoopTest, RejectsWrongScene) {
    OpenLoop open_loop = openLoop(HAGEN_SOURCE_DIR "/rawlogs/orchard.rawlog", {"oracle"});
    open_loop.scene = {"wires", 1};
    EXPECT_THAT(test::messageOf([&] { runOpenLoop(open_loop); }),
                HasSubstr("was not simulated in wires with seed 1"));
}

/// Scans after a clock reset must not serve as later scans of earlier ones.
TEST_F(OpenLoopTest, RestartsWhenClockJumpsBack) {
    const fs::path log = wallFlight(8);
    const auto hitsWith = [&](double first_s) {
        std::ofstream times(log / "times.txt");
        std::vector<recordings::TimedPose> poses;
        for (int i = 0; i < 8; ++i) {
            const double time_s = i == 0 ? first_s : 100 + 0.1 * i;
            times << time_s << "\n";
            poses.push_back({time_s, CPose3D(0.1 * i, 0, 2, 0, 0, 0)});
        }
        times.close();
        recordings::writeTumPoses(log / "poses.tum", poses);
        std::vector<std::size_t> scored;
        OpenLoopListener listener;
        listener.row = [&](const OpenLoopRow& row, const OpenLoopCost&) {
            scored.push_back(row.all.scored);
        };
        runOpenLoop(wallsOnly(log), listener);
        return scored;
    };
    const std::vector<std::size_t> in_order = hitsWith(100), back = hitsWith(100000);
    ASSERT_EQ(in_order.size(), 8u);
    ASSERT_EQ(back.size(), 8u);
    EXPECT_GT(in_order[0], 0u);
    EXPECT_EQ(back[0], 0u);
    EXPECT_EQ(std::vector<std::size_t>(back.begin() + 1, back.end()),
              std::vector<std::size_t>(in_order.begin() + 1, in_order.end()));
}

TEST_F(OpenLoopTest, KeepsResultsBeforeCorruptScan) {
    const fs::path log = wallFlight(6);
    fs::resize_file(log / "velodyne/1004.bin", 1001);
    try {
        runOpenLoop(wallsOnly(log));
        FAIL() << "the corrupt scan is not reported";
    } catch (const OpenLoopEnded& ended) {
        EXPECT_THAT(ended.what(), HasSubstr("1004.bin"));
        EXPECT_EQ(ended.result.scans, 4u);
        EXPECT_EQ(ended.result.models[0].bytes.size(), 4u);
    }
    std::size_t digested = 0;
    OpenLoopListener listener;
    listener.progress = [&](std::size_t scans, std::size_t) { digested = scans; };
    listener.keep_going = [&] { return digested < 2; };
    EXPECT_THROW(runOpenLoop(wallsOnly(log), listener), OpenLoopEnded);
    fs::resize_file(log / "velodyne/1000.bin", 1001);
    EXPECT_THAT(test::messageOf([&] { runOpenLoop(wallsOnly(log)); }),
                HasSubstr("none of its scans"));
}

}  // namespace
}  // namespace hagen::avoidance
