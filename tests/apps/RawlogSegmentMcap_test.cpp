// rawlog-segment --mcap.
#include "recordings/clouds/CloudFile.h"

#include <map>
#include <sstream>

#include "support/SegmentTest.h"

namespace hagen {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;

class RawlogSegmentMcap : public test::SegmentTest {
 protected:
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

TEST_F(RawlogSegmentMcap, OwnOutputGetsSameLabels) {
    // Converts to clouds first, because packets specify beams more precisely than clouds.
    expectSuccess({"-q", "-i", recording(), "--mcap", path("clouds.mcap"), "--to", "4"});
    expectSuccess({"-q", "-i", path("clouds.mcap"), "-c", config("vlp16"), "--mcap", path("a.mcap"),
                   "--clouds", path("a")});
    const auto again =
        expectSuccess({"-i", path("a.mcap"), "-c", config("vlp16"), "--clouds", path("b")});
    for (const char* const field :
         {"x", "y", "z", "intensity", "time", "ring", "label", "obstacle", "input_label"}) {
        EXPECT_TRUE(columnOf("b", field) == columnOf("a", field)) << field;
    }
    EXPECT_GT(columnOf("a", "x").size(), 50000u);
    EXPECT_TRUE(columnOf("b", "input_label_") == columnOf("a", "label"));
    EXPECT_THAT(again.out, HasSubstr("poses of 5 of 5 scans: geometry_msgs/PoseStamped on "));
}

/// tests/recordings/read_mcap.mjs uses the npm packages of the format's authors.
TEST_F(RawlogSegmentMcap, ReferenceReaderAgrees) {
    const fs::path modules = test::dataFolder("HAGEN_NODE_MODULES");
    if (modules.empty()) GTEST_SKIP() << "HAGEN_NODE_MODULES is not a folder with @mcap/core";
    expectSuccess(
        {"-q", "-i", recording(), "--mcap", path("out.mcap"), "--stats", path("out.json")});
    const auto read = test::run(
        "/usr/bin/env",
        {"-C", modules.string(), "node",
         std::string(HAGEN_SOURCE_DIR) + "/tests/recordings/read_mcap.mjs", path("out.mcap")});
    if (read.exit_code == 127 || read.exit_code == 77) {
        GTEST_SKIP() << "node, a package or zstd is missing: " << read.err;
    }
    ASSERT_EQ(read.exit_code, 0) << read.err;
    const auto stats = readJson("out.json");
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
    // The last line summarises the file.
    EXPECT_EQ(line["profile"], "ros2");
    EXPECT_EQ(line["messages"], "40");
    EXPECT_EQ(line["chunks"], line["chunkIndexes"]);
    EXPECT_EQ(line["topics"].size(), 4u);
}

TEST_F(RawlogSegmentMcap, RejectsInvalidOutputs) {
    folder_.write("out.mcap", "mine");
    folder_.write("in.mcap", "mine");
    fs::create_directory(path("folder.mcap"));
    const Arguments log{"-i", recording()};
    expectFailures(log, 1,
                   {{{"--mcap", path("out.mcap")}, "out.mcap exists; use --overwrite"},
                    {{"--mcap", path("folder.mcap"), "--overwrite"}, "not a file"},
                    {{"--mcap", path("in.mcap/out.mcap")}, "in.mcap: cannot be created"}});
    expectFailures(log, 2,
                   {{{"--mcap", path("out.bag")}, "does not end in .mcap"},
                    {{"--mcap", ""}, "must not be empty"}});
    expectFailure({"-i", path("in.mcap"), "--mcap", path("in.mcap"), "--overwrite"}, 1,
                  "is or contains the input");
    EXPECT_EQ(test::readFile(path("out.mcap")), "mine");
}

}  // namespace
}  // namespace hagen
