// rawlog-segment --mcap, as a user would run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/recordings/CloudFile.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "support/ProgramTest.h"

namespace hagen {
namespace {

using testing::AllOf;
using testing::HasSubstr;

namespace fs = std::filesystem;

class RawlogSegmentMcap : public test::ProgramTest {
 protected:
    test::Outcome run(const std::vector<std::string>& arguments) const override {
        return test::run(HAGEN_RAWLOG_SEGMENT, arguments);
    }
    /// Ten scans with poses.
    static std::string recording() { return HAGEN_SOURCE_DIR "/rawlogs/poles_and_wall.rawlog"; }
    static std::string config() { return std::string(HAGEN_SOURCE_DIR) + "/config/vlp16.yaml"; }
    /// All numbers of a field in a folder of labelled clouds.
    std::vector<double> columnOf(const std::string& folder, const char* name) const {
        std::set<fs::path> files;
        for (const auto& file : fs::directory_iterator(path(folder))) {
            if (recordings::hasCloudName(file.path())) files.insert(file.path());
        }
        std::vector<double> numbers;
        for (const fs::path& file : files) {
            const auto table = recordings::readCloud(file).table;
            const auto more = observations::columnOf(table, *findField(table, {name}));
            numbers.insert(numbers.end(), more.begin(), more.end());
        }
        return numbers;
    }
};

TEST_F(RawlogSegmentMcap, ItsOutputIsSegmentedToTheSameLabels) {
    // Clouds, so that both runs get the same numbers: of packets, beams would be known better.
    ASSERT_EQ(run({"-q", "-i", recording(), "--mcap", path("clouds.mcap")}).exit_code, 0);
    ASSERT_EQ(run({"-q", "-i", path("clouds.mcap"), "-c", config(), "--mcap", path("a.mcap"),
                   "--clouds", path("a")})
                  .exit_code,
              0);
    const auto again = run({"-i", path("a.mcap"), "-c", config(), "--clouds", path("b")});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    for (const char* const field : {"x", "y", "z", "intensity", "time", "ring", "label"}) {
        const auto due = columnOf("a", field);
        ASSERT_GT(due.size(), 100000u);
        EXPECT_EQ(columnOf("b", field), due) << field;
    }
    EXPECT_EQ(columnOf("b", "obstacle"), columnOf("a", "obstacle"));
    EXPECT_EQ(columnOf("b", "input_label"), columnOf("a", "input_label"));
    EXPECT_EQ(columnOf("b", "input_label_"), columnOf("a", "label"));
    EXPECT_THAT(again.out, HasSubstr("poses of 10 of 10 scans: geometry_msgs/PoseStamped on "));
}

TEST_F(RawlogSegmentMcap, SummaryAndStatisticsCountTheSame) {
    const auto outcome =
        run({"-i", recording(), "--mcap", path("out.mcap"), "--stats", path("out.json")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto stats = nlohmann::json::parse(test::readFile(path("out.json")));
    EXPECT_EQ(stats["outputs"]["mcap"], path("out.mcap"));
    EXPECT_EQ(stats["mcap"]["scans"], stats["scans"].size());
    EXPECT_EQ(stats["mcap"]["points"], stats["returns"]["all"]);
    EXPECT_EQ(stats["mcap"]["messages"], 40);
    EXPECT_GT(stats["mcap"]["boxes"], 10);
    EXPECT_THAT(outcome.out, HasSubstr("MCAP: " + path("out.mcap") + " (10 scans, " +
                                       stats["mcap"]["points"].dump() + " points, " +
                                       stats["mcap"]["boxes"].dump() + " boxes, 40 messages)"));
}

TEST_F(RawlogSegmentMcap, TheSameBytesForAnyNumberOfThreads) {
    for (const std::string jobs : {"1", "3"}) {
        ASSERT_EQ(run({"-q", "-i", recording(), "--mcap", path(jobs + ".mcap"), "--jobs", jobs})
                      .exit_code,
                  0);
    }
    EXPECT_TRUE(test::readFile(path("1.mcap")) == test::readFile(path("3.mcap")));
}

/// tests/recordings/read_mcap.mjs, which needs packages of npm: readers of the format's authors.
TEST_F(RawlogSegmentMcap, AnotherReaderFindsTheSame) {
    const fs::path modules = test::dataFolder("HAGEN_NODE_MODULES");
    if (modules.empty()) GTEST_SKIP() << "HAGEN_NODE_MODULES names no folder with @mcap/core";
    ASSERT_EQ(run({"-q", "-i", recording(), "--mcap", path("out.mcap"), "--clouds", path("out"),
                   "--stats", path("out.json")})
                  .exit_code,
              0);
    const auto read = test::run(
        "/usr/bin/env",
        {"-C", modules.string(), "node",
         std::string(HAGEN_SOURCE_DIR) + "/tests/recordings/read_mcap.mjs", path("out.mcap")});
    if (read.exit_code == 127 || read.exit_code == 77) {
        GTEST_SKIP() << "node, a package or zstd is not there: " << read.err;
    }
    ASSERT_EQ(read.exit_code, 0) << read.err;
    const auto stats = nlohmann::json::parse(test::readFile(path("out.json")));
    std::map<std::string, int> messages;
    std::size_t points = 0, boxes = 0;
    nlohmann::json line;
    std::istringstream lines(read.out);
    for (std::string text; std::getline(lines, text);) {
        line = nlohmann::json::parse(text);
        if (!line.contains("topic")) continue;
        ++messages[line["topic"]];
        const auto& value = line["value"];
        if (line["type"] == "sensor_msgs/msg/PointCloud2") {
            EXPECT_EQ(value["header"]["frame_id"], "lidar");
            EXPECT_EQ(value["fields"].size(), 8u);
            EXPECT_EQ(value["row_step"],
                      value["point_step"].get<int>() * value["width"].get<int>());
            points += value["width"].get<std::size_t>();
        } else if (line["type"] == "visualization_msgs/msg/MarkerArray") {
            const auto& markers = value["markers"];
            ASSERT_GT(markers.size(), 0u);
            EXPECT_EQ(markers[0]["action"], 3);  // DELETEALL
            for (std::size_t i = 1; i < markers.size(); ++i) {
                EXPECT_EQ(markers[i]["action"], 0);
                EXPECT_EQ(markers[i]["type"], 1);  // CUBE
                EXPECT_GT(markers[i]["id"], 0);
                EXPECT_GT(markers[i]["scale"]["z"], 0);
            }
            boxes += markers.size() - 1;
        } else if (line["type"] == "tf2_msgs/msg/TFMessage") {
            EXPECT_EQ(value["transforms"][0]["header"]["frame_id"], "map");
            EXPECT_EQ(value["transforms"][0]["child_frame_id"], "lidar");
        }
    }
    EXPECT_EQ(
        messages,
        (std::map<std::string, int>{
            {"/lidar/obstacles", 10}, {"/lidar/points", 10}, {"/lidar/pose", 10}, {"/tf", 10}}));
    EXPECT_EQ(points, stats["mcap"]["points"]);
    EXPECT_EQ(boxes, stats["mcap"]["boxes"]);
    // The last line: the summary of the file.
    EXPECT_EQ(line["profile"], "ros2");
    EXPECT_EQ(line["messages"], "40");
    EXPECT_EQ(line["chunks"], line["chunkIndexes"]);
    EXPECT_EQ(line["topics"].size(), 4u);
}

// Failures

TEST_F(RawlogSegmentMcap, AnExistingFileIsReplacedOnlyIfAsked) {
    folder_.write("out.mcap", "mine");
    expectFailure({"-i", recording(), "--mcap", path("out.mcap")}, 1,
                  "out.mcap exists; use --overwrite");
    EXPECT_EQ(test::readFile(path("out.mcap")), "mine");
    ASSERT_EQ(run({"-q", "-i", recording(), "--mcap", path("out.mcap"), "--overwrite"}).exit_code,
              0);
    EXPECT_GT(fs::file_size(path("out.mcap")), 100000u);
    fs::create_directory(path("folder.mcap"));
    expectFailure({"-i", recording(), "--mcap", path("folder.mcap"), "--overwrite"}, 1,
                  "not a file");
    fs::copy(path("out.mcap"), path("in.mcap"));
    expectFailure({"-i", path("in.mcap"), "--mcap", path("in.mcap"), "--overwrite"}, 1,
                  "is or contains the input");
}

TEST_F(RawlogSegmentMcap, WhatCannotBeWrittenIsNamed) {
    expectFailure({"-i", recording(), "--mcap", path("none") + "/out.mcap"}, 1,
                  "none: no such folder");
    expectFailure({"-i", recording(), "--mcap", path("out.bag")}, 2, "does not end in .mcap");
    expectFailure({"-i", recording(), "--mcap", ""}, 2, "must not be empty");
}

TEST_F(RawlogSegmentMcap, AFullDiskLeavesNothing) {
    // A limit on file sizes is as good as a full disk.
    const auto outcome =
        test::run("bash", {"-c", "trap \"\" XFSZ; ulimit -f 200; exec \"$0\" \"$@\"",
                           HAGEN_RAWLOG_SEGMENT, "-i", recording(), "--mcap", path("out.mcap")});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("out.mcap: cannot be written"));
    EXPECT_TRUE(files().empty());
}

TEST_F(RawlogSegmentMcap, ACutInputKeepsWhatWasBefore) {
    ASSERT_EQ(run({"-q", "-i", recording(), "--mcap", path("in.mcap")}).exit_code, 0);
    fs::resize_file(path("in.mcap"), fs::file_size(path("in.mcap")) * 2 / 3);
    const auto outcome = run({"-i", path("in.mcap"), "--mcap", path("out.mcap")});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("in.mcap: "), HasSubstr("is cut off"),
                                   HasSubstr("out.partial.mcap")));
    EXPECT_FALSE(fs::exists(path("out.mcap")));
    const auto partial = run({"-i", path("out.partial.mcap"), "--stats", path("out.json")});
    EXPECT_EQ(partial.exit_code, 0) << partial.err;
    const auto stats = nlohmann::json::parse(test::readFile(path("out.json")));
    EXPECT_GT(stats["scans"].size(), 2u);
    EXPECT_LT(stats["scans"].size(), 10u);
}

}  // namespace
}  // namespace hagen
