#include <gmock/gmock.h>
#include <hagen/convert/WriteCloud.h>
#include <hagen/recordings/ScanFolder.h>
#include <hagen/recordings/ScanSource.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include "mrpt/TableCloud.h"
#include "recordings/bags/BagFile.h"

#include "support/PointColumn.h"
#include "support/PoleConversion.h"

namespace hagen::convert {
namespace {

namespace fs = std::filesystem;
using observations::NumberType;
using observations::PointTable;
using test::column;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

class McapOutputTest : public test::PoleConversion, public testing::Test {
 protected:
    McapOutputTest() { conversion_.mcap = folder_ / "out.mcap"; }
    /// The scan plus two points that are not returns, with fields of other types.
    PointTable tableOfScan() const {
        const PointTable scan = observations::tableOf(observed_.scan);
        PointTable table;
        table.points = scan.points + 2;
        for (const auto& field : scan.fields) {
            std::vector<double> numbers = columnOf(scan, field);
            const bool is_x = field.name == "x";
            numbers.insert(numbers.begin(), is_x ? std::numeric_limits<double>::infinity() : 7);
            numbers.insert(numbers.begin() + 5, is_x ? std::numeric_limits<double>::infinity() : 8);
            addColumn(field.name, field.type, numbers, table);
        }
        std::vector<double> numbers, long_numbers;
        for (std::size_t i = 0; i < table.points; ++i) {
            numbers.push_back(static_cast<double>(i % 120));
            long_numbers.push_back(9007199254740994.0 + 2.0 * static_cast<double>(i));
        }
        addColumn("of_uint8", NumberType::UInt8, numbers, table);
        addColumn("of_int16", NumberType::Int16, numbers, table);
        addColumn("of_float64", NumberType::Float64, numbers, table);
        addColumn("of_int64", NumberType::Int64, long_numbers, table);
        addColumn("label", NumberType::UInt8, numbers, table);
        return table;
    }
    /// The clouds of a topic, read with our own reader.
    static std::vector<mrpt::obs::CObservation::ConstPtr> cloudsOf(const fs::path& file,
                                                                   const std::string& topic) {
        recordings::SourceOptions options;
        options.topics = {topic};
        const auto source = recordings::openRecording(file, options);
        std::vector<mrpt::obs::CObservation::ConstPtr> clouds;
        while (const auto scan = source->nextScan()) clouds.push_back(scan->observation);
        return clouds;
    }
    /// The number of messages per topic.
    static std::map<std::string, int> topicsOf(const fs::path& file) {
        const auto bag = recordings::openBag(file);
        std::map<std::string, int> topics;
        for (recordings::BagMessage message; bag->next(message);)
            ++topics[bag->topics()[message.topic].name];
        return topics;
    }
};

TEST_F(McapOutputTest, WritesReadablePointsAndFields) {
    const PointTable input = tableOfScan();
    conversion_.input = folder_ / "1700000000.25.pcd";
    writeCloud(conversion_.input, convert::OutputFormat::Pcd, input);
    conversion_.folder = folder_ / "kitti";
    const ConversionReport report = convertCounting();
    EXPECT_EQ(report.mcap.scans, 1u);
    EXPECT_EQ(report.mcap.points, input.points);
    EXPECT_EQ(report.mcap.boxes, 1u);
    EXPECT_EQ(report.mcap.messages, 2u);
    const auto clouds = cloudsOf(conversion_.mcap, "/lidar/points");
    ASSERT_EQ(clouds.size(), 1u);
    EXPECT_EQ(clouds[0]->timestamp, mrpt::Clock::fromDouble(1700000000.25));
    const PointTable output = observations::tableCloudOf(*clouds[0])->table();
    EXPECT_EQ(namesOf(output),
              "x, y, z, intensity, time, of_uint8, of_int16, of_float64, of_int64, input_label, "
              "label, obstacle");
    for (const char* const name :
         {"x", "y", "z", "intensity", "time", "of_uint8", "of_int16", "of_float64", "of_int64"}) {
        EXPECT_EQ(column(output, name), column(input, name)) << name;
        const bool is_long = std::string(name) == "of_int64";
        EXPECT_EQ(findField(output, {name})->type,
                  is_long ? NumberType::Float64 : findField(input, {name})->type);
    }
    EXPECT_EQ(column(output, "input_label"), column(input, "label"));
    EXPECT_EQ(findField(output, {"label"})->type, NumberType::UInt8);
    EXPECT_EQ(findField(output, {"obstacle"})->type, NumberType::UInt32);

    const auto entries = recordings::readLabelEntries(folder_ / "kitti/labels/1700000000.25.label");
    const auto labels = column(output, "label"), obstacles = column(output, "obstacle");
    ASSERT_EQ(labels.size(), entries.size() + 2);
    std::size_t i = 0, of_obstacles = 0;
    for (std::size_t at = 0; at < labels.size(); ++at) {
        const bool is_return = at != 0 && at != 5;
        ASSERT_EQ(labels[at], is_return ? entries[i] & 0xffff : 0);
        ASSERT_EQ(obstacles[at], is_return ? entries[i] >> 16 : 0);
        of_obstacles += obstacles[at] > 0;
        i += is_return;
    }
    EXPECT_GT(of_obstacles, 10u);
    EXPECT_THAT(remarks_, Contains(HasSubstr("the MCAP: an input field")));
    EXPECT_THAT(remarks_, Contains(HasSubstr("'of_int64' is int64, which PointCloud2 does not")));
}

TEST_F(McapOutputTest, WritesPacketRingsAndTimes) {
    conversion_.input = writeRawlog({test::poleScanFrom(0, "lidar")});
    convertCounting();
    const auto clouds = cloudsOf(conversion_.mcap, "/lidar/points");
    ASSERT_EQ(clouds.size(), 1u);
    const PointTable output = observations::tableCloudOf(*clouds[0])->table();
    EXPECT_EQ(namesOf(output), "x, y, z, intensity, time, ring, label, obstacle");
    const Scan& scan = observed_.scan;
    EXPECT_EQ(column(output, "ring"), std::vector<double>(scan.row.begin(), scan.row.end()));
    EXPECT_EQ(column(output, "time"), std::vector<double>(scan.time_s.begin(), scan.time_s.end()));
}

TEST_F(McapOutputTest, WritesSensorPoses) {
    std::vector<mrpt::obs::CObservation::Ptr> entries;
    for (const double x_m : {0.0, 0.25, 0.5}) {
        const auto scan = test::poleScanFrom(x_m, "lidar");
        scan->sensorPose = mrpt::poses::CPose3D(0, 0, 0.5, 0, 0, 0);
        auto pose = mrpt::obs::CObservationRobotPose::Create();
        pose->timestamp = scan->timestamp;
        pose->pose.mean = mrpt::poses::CPose3D(x_m, 3, 1.5, 0.25, 0, 0);
        entries.insert(entries.end(), {pose, scan});
    }
    conversion_.input = writeRawlog(entries);
    EXPECT_EQ(convertCounting().mcap.messages, 12u);
    EXPECT_THAT(topicsOf(conversion_.mcap),
                ElementsAre(Pair("/lidar/obstacles", 3), Pair("/lidar/points", 3),
                            Pair("/lidar/pose", 3), Pair("/tf", 3)));
    const auto source = recordings::openRecording(conversion_.mcap);
    source->usePoses("");
    for (const double x_m : {0.0, 0.25, 0.5}) {
        const auto scan = source->nextScan();
        ASSERT_TRUE(scan && scan->pose.sensor_pose);
        const mrpt::poses::CPose3D& pose = *scan->pose.sensor_pose;
        EXPECT_NEAR(pose.x(), x_m, 1e-9);
        EXPECT_NEAR(pose.y(), 3, 1e-9);
        EXPECT_NEAR(pose.z(), 2, 1e-9);
        EXPECT_NEAR(pose.yaw(), 0.25, 1e-9);
    }
}

TEST_F(McapOutputTest, WritesTopicsPerLidar) {
    conversion_.input = writeRawlog({test::poleScanFrom(0, "front"), test::poleScanFrom(1, "a b"),
                                     test::poleScanFrom(2, "a/b"), test::poleScanFrom(3, "3 d"),
                                     test::poleScanFrom(4, "map"), test::poleScanFrom(5, "")});
    EXPECT_EQ(convertCounting().mcap.scans, 6u);
    std::vector<std::string> names;
    for (const auto& [topic, messages] : topicsOf(conversion_.mcap)) {
        if (topic.find("/points") != std::string::npos) names.push_back(topic);
    }
    EXPECT_THAT(names, ElementsAre("/a_b/points", "/a_b_2/points", "/front/points", "/lidar/points",
                                   "/lidar_3_d/points", "/map_lidar/points"));
    EXPECT_THAT(remarks_, Contains("the MCAP: the LiDAR 'a/b' is renamed to 'a_b_2' to conform "
                                   "to ROS naming rules"));
}

TEST_F(McapOutputTest, ReportsTimesOutsideRosRange) {
    const auto early = test::poleScanFrom(0, "lidar"), late = test::poleScanFrom(1, "lidar");
    early->timestamp = mrpt::Clock::fromDouble(-5);
    late->timestamp = mrpt::Clock::fromDouble(2147483648.0);
    conversion_.input = writeRawlog({early, late, test::poleScanFrom(2, "lidar")});
    EXPECT_EQ(convertCounting().mcap.scans, 3u);
    EXPECT_THAT(remarks_, Contains(HasSubstr("the MCAP: 2 of 3 scans have no time")));
}

TEST_F(McapOutputTest, WritesNoFileWithoutScans) {
    auto pose = mrpt::obs::CObservationRobotPose::Create();
    pose->timestamp = mrpt::Clock::fromDouble(1);
    conversion_.input = writeRawlog({pose});
    EXPECT_EQ(convertCounting().mcap.scans, 0u);
    EXPECT_FALSE(fs::exists(conversion_.mcap));
}

TEST_F(McapOutputTest, KeepsPartialFileOnInterrupt) {
    conversion_.input = writeRawlog({test::poleScanFrom(0, "lidar"), test::poleScanFrom(1, "lidar"),
                                     test::poleScanFrom(2, "lidar")});
    conversion_.jobs = 1;
    // The preceding pose search also calls keep_going.
    int due = 0;
    ConversionListener counting;
    counting.keep_going = [&] { return ++due > 0; };
    convert(conversion_, counting);
    ConversionListener listener;
    int asked = 0;
    listener.keep_going = [&] { return ++asked < due - 1; };
    conversion_.mcap = folder_ / "other.mcap";
    EXPECT_THAT(test::messageOf([&] { convert(conversion_, listener); }),
                AllOf(HasSubstr("interrupted"), HasSubstr("other.partial.mcap")));
    EXPECT_FALSE(fs::exists(conversion_.mcap));
    const std::size_t scans = cloudsOf(folder_ / "other.partial.mcap", "/lidar/points").size();
    EXPECT_GE(scans, 1u);
    EXPECT_LT(scans, 3u);
}

}  // namespace
}  // namespace hagen::convert
