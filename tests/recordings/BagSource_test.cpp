#include <gmock/gmock.h>
#include <hagen/recordings/ScanSource.h>
#include "recordings/PoseFile.h"
#include "recordings/bags/BagFile.h"

#include <algorithm>

#include "support/BagWriter.h"
#include "support/Program.h"

namespace hagen::recordings {
namespace {

using mrpt::poses::CPose3D;
using test::SentMessage;
using testing::Each;
using testing::HasSubstr;

namespace fs = std::filesystem;
constexpr double kBagSourceStart_s = 1700000000;

/// Two LiDARs with three clouds each, on a vehicle that moves at 10 m/s.
class BagSourceTest : public testing::Test {
 protected:
    BagSourceTest() {
        messages_.push_back(
            test::transformMessage("/tf_static", kBagSourceStart_s, "base_link", "front", 0, 0, 3));
        for (int i = 0; i < 3; ++i) {
            const double time_s = kBagSourceStart_s + 0.1 * i;
            messages_.push_back(test::cloudMessage("/front", time_s, "front", {1, 2, 3, 4}));
            messages_.push_back(test::cloudMessage("/rear", time_s, "rear", {5, 6, 7, 8}));
            messages_.push_back(
                test::odometryMessage("/odom", time_s, "odom", "base_link", i, 0, 0));
        }
        bag_ = test::writeBytes(folder_ / "flight.bag", test::ros1BagOf(messages_));
    }
    std::unique_ptr<ScanSource> open(const SourceOptions& options = {}) const {
        return openRecording(bag_, options);
    }
    test::TemporaryFolder folder_;
    std::vector<SentMessage> messages_;
    fs::path bag_;
};

TEST_F(BagSourceTest, ReturnsEntryPerScan) {
    SourceOptions options;
    options.folder_objects = observations::CloudClass::Simple;
    const auto source = open(options);
    source->useSettings({});
    for (std::size_t i = 0; i < 6; ++i) {
        const auto entry = source->nextEntry();
        ASSERT_TRUE(entry);
        EXPECT_EQ(entry->number, i);
        EXPECT_TRUE(entry->object);
        ASSERT_EQ(entry->scans.size(), 1u);
        EXPECT_EQ(entry->scans[0].observation->sensorLabel, i % 2 == 0 ? "front" : "rear");
    }
    EXPECT_FALSE(source->nextEntry());
    EXPECT_EQ(source->scansKnown(), 6u);
}

TEST_F(BagSourceTest, UsesPosesAndMountFromBag) {
    const auto source = open();
    source->usePoses("");
    EXPECT_EQ(source->poses().source, "nav_msgs/Odometry on /odom");
    for (int i = 0; i < 3; ++i) {
        const auto front = source->nextScan(), rear = source->nextScan();
        ASSERT_TRUE(front->pose.sensor_pose && rear->pose.sensor_pose);
        EXPECT_NEAR(front->pose.sensor_pose->x(), i, 1e-9);
        EXPECT_NEAR(front->pose.sensor_pose->z(), 3, 1e-9);
        EXPECT_NEAR(rear->pose.sensor_pose->z(), 0, 1e-9);
        EXPECT_TRUE(front->pose.attitude);
    }
}

TEST_F(BagSourceTest, KeepsMountInLidarPoses) {
    const auto poseOf = [&](const std::string& moved) {
        std::vector<test::SentMessage> messages;
        for (int i = 0; i < 5; ++i) {
            const double time_s = kBagSourceStart_s + 0.1 * i;
            messages.push_back(test::transformMessage("/tf", time_s, "map", moved, i, 0, 0));
            messages.push_back(test::cloudMessage("/points", time_s, "lidar", {1, 2, 3, 4}));
        }
        const auto file = folder_ / (moved + ".mcap");
        test::writeBytes(file, test::mcapOf(messages));
        const auto source = openRecording(file);
        source->usePoses("");
        source->nextScan();
        return source->nextScan()->pose;
    };
    EXPECT_TRUE(poseOf("lidar").is_of_sensor);
    EXPECT_TRUE(poseOf("lidar").attitude_is_of_sensor);
    // The LiDAR's mount is unknown.
    EXPECT_TRUE(poseOf("base_link").is_of_sensor);
    EXPECT_TRUE(poseOf("base_link").attitude_is_of_sensor);
}

TEST_F(BagSourceTest, PrefersPosesFromFile) {
    SourceOptions options;
    options.topics = {"/rear"};
    writeKittiPoses(folder_ / "poses.txt", {CPose3D(), CPose3D(5, 0, 0, 0, 0, 0), CPose3D()});
    auto source = open(options);
    source->usePoses(folder_ / "poses.txt");
    source->nextScan();
    EXPECT_NEAR(source->nextScan()->pose.sensor_pose->x(), 5, 1e-6);
    writeTumPoses(folder_ / "poses.tum", {{kBagSourceStart_s, CPose3D(9, 0, 0, 0, 0, 0)}});
    source = open(options);
    source->usePoses(folder_ / "poses.tum");
    EXPECT_NEAR(source->nextScan()->pose.sensor_pose->x(), 9, 1e-6);
    EXPECT_THAT(test::messageOf([&] { open()->usePoses(folder_ / "poses.txt"); }),
                HasSubstr("the log has 2 LiDARs"));
}

TEST_F(BagSourceTest, ReadsSelectedEntriesLabelsAndTopics) {
    SourceOptions options;
    options.first_scan = 2;
    options.last_scan = 3;
    options.sensor_labels = {"rear"};
    auto source = open(options);
    const auto scan = source->nextScan();
    ASSERT_TRUE(scan);
    EXPECT_EQ(titleOf(*scan), "scan 3 (rear)");
    EXPECT_FALSE(source->nextScan());
    EXPECT_EQ(source->entriesSkipped(), 2u);
    EXPECT_THAT(source->remarks(), Each(HasSubstr("(up to the last entry converted)")));
    options = {};
    options.topics = {"/front"};
    EXPECT_EQ(open(options)->scanTimes().size(), 1u);
    EXPECT_EQ(open()->scanTimes().at("rear").size(), 3u);
    options.topics = {"/none"};
    EXPECT_THAT(test::messageOf([&] { open(options); }), HasSubstr("has no topic '/none'"));
}

TEST_F(BagSourceTest, ReportsTruncationAfterScans) {
    fs::resize_file(bag_, fs::file_size(bag_) - 10);
    const auto source = open();
    for (int i = 0; i < 6; ++i) EXPECT_TRUE(source->nextScan());
    EXPECT_THROW(source->nextScan(), recordings::BrokenRecording);
    EXPECT_EQ(open()->scanTimes().at("front").size(), 3u);
}

TEST_F(BagSourceTest, ReportsLookAheadErrors) {
    const auto whole = test::mcapOf(messages_, {"none", 1});
    const fs::path cut = folder_ / "cut.mcap", bag = folder_ / "flight.mcap";
    for (const std::size_t last : {0u, 5u, 100u}) {
        test::writeBytes(bag, whole.substr(0, whole.size() / 2));
        SourceOptions options;
        options.last_scan = last;
        options.keep_going = [&] {  // replaces the file during reading
            fs::remove(bag);
            test::writeBytes(bag, whole);
            return true;
        };
        const auto source = openRecording(bag, options);
        for (std::size_t i = 0; i <= std::min<std::size_t>(last, 5); ++i) {
            EXPECT_TRUE(source->nextScan());
        }
        const std::string message = test::messageOf([&] { source->nextScan(); });
        const bool is_needed = last > 0;
        EXPECT_THAT(message, HasSubstr(is_needed ? "(found while reading ahead)" : ""));
        EXPECT_EQ(message.empty(), !is_needed) << message;
    }
}

TEST_F(BagSourceTest, StopsOnRequest) {
    SourceOptions options;
    options.keep_going = [] { return false; };
    EXPECT_THROW(open(options), Interrupted);
    bool goes_on = true;
    options.keep_going = [&] { return goes_on; };
    const auto source = open(options);
    EXPECT_TRUE(source->nextEntry());
    goes_on = false;
    EXPECT_THROW(source->nextEntry(), Interrupted);
}

TEST_F(BagSourceTest, StopsBetweenScans) {
    std::vector<test::SentMessage> messages = messages_;
    for (int i = 0; i < 100; ++i) messages.push_back(test::stringMessage("/text", 2e9, "a"));
    const auto file = test::writeBytes(folder_ / "flight.mcap", test::mcapOf(messages));
    bool goes_on = true;
    int asked = 0;
    SourceOptions options;
    options.keep_going = [&] { return goes_on || ++asked <= 50; };
    const auto source = openRecording(file, options);
    for (int i = 0; i < 6; ++i) EXPECT_TRUE(source->nextEntry());
    goes_on = false;
    EXPECT_THROW(source->nextEntry(), Interrupted);
    EXPECT_EQ(asked, 51);
}

}  // namespace
}  // namespace hagen::recordings
