// rawlog-segment on ROS recordings.
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/RawlogReader.h>
#include <hagen/recordings/ScanSource.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include "convert/RawlogWriter.h"

#include "support/BagWriter.h"
#include "support/SegmentTest.h"

namespace hagen {
namespace {

using test::SentMessage;
using testing::HasSubstr;

namespace fs = std::filesystem;

class RawlogSegmentBag : public test::SegmentTest {
 protected:
    /// The recording's scans as packets, as clouds, or as both.
    static std::vector<SentMessage> messagesOfRecording(bool has_packets, bool has_clouds) {
        std::vector<SentMessage> messages;
        const auto source = recordings::openRecording(recording());
        while (const auto scan = source->nextScan()) {
            const auto& velodyne =
                dynamic_cast<const mrpt::obs::CObservationVelodyneScan&>(*scan->observation);
            const double time_s = mrpt::Clock::toDouble(velodyne.timestamp);
            if (has_packets) {
                messages.push_back(test::velodyneMessage("/velodyne_packets", time_s, "velodyne",
                                                         velodyne, 1.327e-3));
            }
            if (!has_clouds) continue;
            observations::ObservedScan observed;
            observations::readObservation(velodyne, {}, observed);
            std::vector<float> xyzi;
            for (std::size_t i = 0; i < observed.scan.size(); ++i) {
                for (const float number : {observed.scan.x_m[i], observed.scan.y_m[i],
                                           observed.scan.z_m[i], observed.scan.intensity[i]}) {
                    xyzi.push_back(number);
                }
            }
            messages.push_back(test::cloudMessage("/velodyne_points", time_s, "velodyne", xyzi));
        }
        return messages;
    }
    /// The program's labels of an input.
    std::string labelled(const std::string& input) const {
        expectSuccess({"-q", "-i", input, "--kitti", path("labels"), "--overwrite"});
        return labelsOf("labels");
    }
};

TEST_F(RawlogSegmentBag, PacketsGetSameLabelsInAnyFormat) {
    const auto messages = messagesOfRecording(true, false);
    const std::string due = labelled(recording());
    EXPECT_GT(due.size(), 100000u);
    const std::string bag =
        test::writeBytes(path("flight.bag"), test::ros1BagOf(messages, {"lz4"}));
    EXPECT_TRUE(labelled(bag) == due);
    EXPECT_EQ(labelled(test::writeBytes(path("flight.mcap"), test::mcapOf(messages, {"zstd"}))),
              due);
    EXPECT_EQ(labelled(test::writeDb3(path("flight.db3"), messages)), due);
    fs::create_directory(path("folder"));
    fs::copy(path("flight.db3"), path("folder") + "/folder_0.db3");
    EXPECT_EQ(labelled(path("folder")), due);
    // File names do not matter.
    fs::rename(bag, path("flight.rawlog"));
    EXPECT_EQ(labelled(path("flight.rawlog")), due);
}

TEST_F(RawlogSegmentBag, CloudsGetSameLabelsAsRawlog) {
    const auto messages = messagesOfRecording(false, true);
    convert::RawlogWriter writer(path("clouds.rawlog"), true);
    const auto source = recordings::openRecording(recording());
    while (const auto scan = source->nextScan()) {
        observations::ObservedScan observed;
        observations::readObservation(*scan->observation, {}, observed);
        writer.write(*observations::observationOf(observed.scan, "velodyne_points",
                                                  scan->observation->timestamp));
    }
    writer.commit();
    const std::string due = labelled(path("clouds.rawlog"));
    EXPECT_EQ(labelled(test::writeBytes(path("flight.mcap"), test::mcapOf(messages))), due);
    EXPECT_EQ(labelled(test::writeBytes(path("flight.bag"), test::ros1BagOf(messages))), due);
}

TEST_F(RawlogSegmentBag, SummaryListsTopicsAndPoses) {
    auto messages = messagesOfRecording(true, true);
    const double start_s = messages.front().time_s;
    for (int i = 0; i < 100; ++i) {
        messages.push_back(test::odometryMessage("/odom", start_s - 1 + 0.1 * i, "odom",
                                                 "base_link", 0.1 * i, 0, 2));
    }
    messages.push_back(
        test::transformMessage("/tf_static", start_s, "base_link", "velodyne", 1, 0, 0.5));
    const std::string bag = test::writeBytes(path("flight.bag"), test::ros1BagOf(messages));
    const auto outcome = run({"-i", bag, "-o", path("out.rawlog"), "--octomap", path("map.bt")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("sensor velodyne_packets: VLP-16, 16 beams"));
    EXPECT_THAT(outcome.out, HasSubstr("nav_msgs/Odometry on /odom"));
    EXPECT_THAT(outcome.err, HasSubstr("the recording: velodyne_packets (/velodyne_packets): "));
    EXPECT_THAT(outcome.err, HasSubstr("/velodyne_points is not read: "));
    recordings::RawlogReader reader(path("out.rawlog"));
    const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservationVelodyneScan>(reader.next());
    ASSERT_TRUE(scan);
    EXPECT_NEAR(scan->sensorPose.x(), 1, 1e-9);
    EXPECT_NEAR(scan->sensorPose.z(), 0.5, 1e-9);
    const auto clouds =
        run({"-i", bag, "--topic", "velodyne_points", "-o", path("clouds.rawlog"), "--to", "1"});
    ASSERT_EQ(clouds.exit_code, 0) << clouds.err;
    EXPECT_THAT(clouds.out, HasSubstr("2 LiDAR scans in 2 entries (scans 0 to 1 of the input"));
    EXPECT_THAT(clouds.out, HasSubstr("sensor velodyne_points: 16 beams recovered (VLP-16)"));
}

TEST_F(RawlogSegmentBag, ReportsWrongTopics) {
    const std::string bag = test::writeBytes(
        path("flight.bag"), test::ros1BagOf({test::stringMessage("/text", 1700000000, "a")}));
    const Arguments output{"-o", path("out.rawlog")};
    expectFailures(with(output, {"-i", bag}), 1,
                   {{{}, "flight.bag: has no LiDAR topic (sensor_msgs/PointCloud2, "},
                    {{"--topic", "/points"},
                     "has no topic '/points'; it has: /text (std_msgs/String, 1 message)"},
                    {{"--topic", "/text"}, "not a LiDAR type"}});
    expectFailure(with(output, {"-i", bag, "--topic"}), 2, "--topic");
    const std::string text = test::writeBytes(path("flight.mcap"), "no recording at all");
    const std::string cloud = test::writeBytes(
        path("few.bag"),
        test::ros1BagOf({test::cloudMessage("/points", 1700000000, "lidar", {1, 2, 3, 4})}));
    expectFailures(
        output, 1,
        {{{"-i", recording(), "--topic", "/points"},
          "is not a ROS recording (.bag, .mcap, .db3 or its folder), so it has no topic"},
         {{"-i", text}, "flight.mcap"},
         {{"-i", cloud, "--octomap", path("a.bt")}, "has no poses"}});
}

/// Bags written by other programs, if they are installed.
class BagsOfOtherPrograms : public RawlogSegmentBag {
 protected:
    static std::string base64(const std::string& bytes) {
        constexpr const char* kDigits =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string text;
        for (std::size_t i = 0; i < bytes.size(); i += 3) {
            std::uint32_t three = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto byte =
                    i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
                three = three << 8 | byte;
            }
            for (std::size_t k = 0; k < 4; ++k) {
                text += i + k > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63];
            }
        }
        return text;
    }
    /// The recording's packets as lines for the scripts in tests/recordings.
    std::string lines() const {
        std::string lines;
        const auto source = recordings::openRecording(recording());
        while (const auto scan = source->nextScan()) {
            const auto& velodyne =
                dynamic_cast<const mrpt::obs::CObservationVelodyneScan&>(*scan->observation);
            auto time_ns = std::llround(1e9 * mrpt::Clock::toDouble(velodyne.timestamp));
            const nlohmann::json header{{"stamp", {{"time_ns", time_ns}}},
                                        {"frame_id", "velodyne"}};
            nlohmann::json packets = nlohmann::json::array();
            for (const auto& packet : velodyne.scan_packets) {
                packets.push_back({{"stamp", {{"time_ns", time_ns}}},
                                   {"data", {{"base64", base64(test::bytesOf(packet))}}}});
                time_ns += 1327000;
            }
            const nlohmann::json message{{"topic", "/velodyne_packets"},
                                         {"type", "velodyne_msgs/VelodyneScan"},
                                         {"time_ns", time_ns},
                                         {"fields", {{"header", header}, {"packets", packets}}}};
            lines += message.dump() + "\n";
        }
        return folder_.write("messages.jsonl", lines);
    }
    static std::string script(const std::string& name) {
        return fs::path(HAGEN_SOURCE_DIR) / "tests/recordings" / name;
    }
};

TEST_F(BagsOfOtherPrograms, RosbagGetsSameLabels) {
    if (test::run("/usr/bin/python3", {"-c", "import rosbag"}).exit_code != 0) {
        GTEST_SKIP() << "python3-rosbag is not installed";
    }
    const std::string messages = lines(), due = labelled(recording());
    for (const std::string compression : {"none", "bz2", "lz4"}) {
        const auto made = test::run("/usr/bin/python3", {script("write_ros1_bag.py"), messages,
                                                         path("a.bag"), compression});
        ASSERT_EQ(made.exit_code, 0) << made.err;
        EXPECT_EQ(labelled(path("a.bag")), due) << compression;
    }
}

TEST_F(BagsOfOtherPrograms, McapGetsSameLabels) {
    const fs::path modules = test::dataFolder("HAGEN_NODE_MODULES");
    if (modules.empty()) GTEST_SKIP() << "HAGEN_NODE_MODULES is not a folder with @mcap/core";
    const std::string messages = lines(), due = labelled(recording());
    for (const std::string kind : {"none", "zstd", "lz4", "plain", "ros1"}) {
        const auto made =
            test::run("/usr/bin/env", {"-C", modules.string(), "node", script("write_ros2_bag.mjs"),
                                       messages, path("a.mcap"), kind});
        ASSERT_EQ(made.exit_code, 0) << made.err;
        EXPECT_EQ(labelled(path("a.mcap")), due) << kind;
    }
    ASSERT_EQ(test::run("/usr/bin/env", {"-C", modules.string(), "node",
                                         script("write_ros2_bag.mjs"), messages, path("cdr.jsonl")})
                  .exit_code,
              0);
    ASSERT_EQ(test::run("/usr/bin/env",
                        {"python3", script("write_db3.py"), path("cdr.jsonl"), path("a.db3")})
                  .exit_code,
              0);
    EXPECT_EQ(labelled(path("a.db3")), due);
}

}  // namespace
}  // namespace hagen
