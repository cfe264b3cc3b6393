#include <gmock/gmock.h>
#include <hagen/convert/WriteCloud.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/ScanFolder.h>
#include "mrpt/TableCloud.h"
#include "recordings/clouds/CloudFile.h"

#include <cmath>
#include <limits>

#include "support/BagWriter.h"
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
using testing::HasSubstr;
using testing::UnorderedElementsAre;

class CloudOutputTest : public test::PoleConversion,
                        public testing::TestWithParam<convert::OutputFormat> {
 protected:
    CloudOutputTest() {
        conversion_.clouds = folder_ / "labelled";
        conversion_.cloud_format = GetParam();
    }
    PointTable labelled(const std::string& name) const {
        return recordings::readCloud(conversion_.clouds / (name + extensionOf(GetParam()))).table;
    }
    /// The scan with additional fields: `ring`, `t`, `range_mm`, `label`.
    PointTable tableOfScan() const {
        PointTable table = observations::tableOf(observed_.scan);
        const Scan& scan = observed_.scan;
        addColumn("ring", NumberType::UInt8, {scan.row.begin(), scan.row.end()}, table);
        std::vector<double> ranges, numbers;
        for (std::size_t i = 0; i < scan.size(); ++i) {
            ranges.push_back(std::floor(1000 * static_cast<double>(scan.range_m[i])));
            numbers.push_back(static_cast<double>(i % 200));
        }
        addColumn("range_mm", NumberType::UInt32, ranges, table);
        addColumn("label", NumberType::UInt8, numbers, table);
        return table;
    }
};

TEST_P(CloudOutputTest, KeepsLivoxTagsAndLines) {
    const auto write = [](test::MessageBytes& bytes) {
        bytes.header(1700000000, "livox").number(std::uint64_t{0}).number(std::uint32_t{500});
        bytes.raw(std::string(4, '\0')).number(std::uint32_t{500});
        for (int i = 0; i < 500; ++i) {
            bytes.number(std::uint32_t{0}).number(5.0f).number(0.01f * static_cast<float>(i));
            bytes.number(-1.0f).number(std::uint8_t{9});
            bytes.number(static_cast<std::uint8_t>(i % 250));
            bytes.number(static_cast<std::uint8_t>(i % 4));
        }
    };
    conversion_.input = test::writeBytes(
        folder_ / "in.bag", test::ros1BagOf({test::sentMessage(
                                "/livox", "livox_ros_driver2/CustomMsg", 1700000000, write)}));
    conversion_.settings.sensor.model = "Mid-360";
    convertCounting();
    const auto tags = column(labelled("000000"), "tag");
    const auto lines = column(labelled("000000"), "line");
    ASSERT_EQ(tags.size(), 500u);
    EXPECT_EQ(tags[249], 249);
    EXPECT_EQ(tags[250], 0);
    EXPECT_EQ(lines[6], 2);
}

TEST_P(CloudOutputTest, KeepsFieldsAndAddsLabels) {
    const PointTable input = tableOfScan();
    conversion_.input = folder_ / "17.pcd";
    writeCloud(conversion_.input, convert::OutputFormat::Pcd, input);
    conversion_.folder = folder_ / "kitti";
    const ConversionReport report = convertCounting();
    EXPECT_EQ(report.clouds, 1u);
    EXPECT_EQ(report.cloud_points, input.points);
    const PointTable output = labelled("17");
    EXPECT_EQ(namesOf(output),
              "x, y, z, intensity, time, ring, range_mm, input_label, label, obstacle");
    for (const char* const name : {"x", "y", "z", "intensity", "time", "ring", "range_mm"}) {
        EXPECT_EQ(column(output, name), column(input, name)) << name;
    }
    EXPECT_EQ(column(output, "input_label"), column(input, "label"));
    EXPECT_EQ(findField(output, {"label"})->type, NumberType::UInt8);
    EXPECT_EQ(findField(output, {"obstacle"})->type, NumberType::UInt32);
    const auto entries = recordings::readLabelEntries(folder_ / "kitti/labels/17.label");
    const auto labels = column(output, "label"), obstacles = column(output, "obstacle");
    ASSERT_EQ(entries.size(), labels.size());
    std::size_t of_obstacles = 0;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        ASSERT_EQ(labels[i], entries[i] & 0xffff);
        ASSERT_EQ(obstacles[i], entries[i] >> 16);
        of_obstacles += obstacles[i] > 0;
    }
    EXPECT_GT(of_obstacles, 10u);
    EXPECT_THAT(remarks_, Contains(HasSubstr("'input_label'")));
}

TEST_P(CloudOutputTest, KeepsPointsWithoutReturns) {
    const PointTable input = tableOfScan();
    PointTable with_others;
    with_others.points = input.points + 2;
    for (const auto& field : input.fields) {
        std::vector<double> numbers = columnOf(input, field);
        const bool is_x = field.name == "x";
        numbers.insert(numbers.begin(), is_x ? std::numeric_limits<double>::quiet_NaN() : 7);
        numbers.insert(numbers.begin() + 5, is_x ? std::numeric_limits<double>::infinity() : 8);
        addColumn(field.name, field.type, numbers, with_others);
    }
    writeCloud(folder_ / "17.ply", convert::OutputFormat::Ply, input);
    conversion_.input = folder_ / "17.ply";
    convertCounting();
    auto labels = column(labelled("17"), "label");
    writeCloud(folder_ / "18.ply", convert::OutputFormat::Ply, with_others);
    conversion_.input = folder_ / "18.ply";
    conversion_.clouds = folder_ / "with_others";
    EXPECT_EQ(convertCounting().returns, input.points);
    labels.insert(labels.begin(), 0);
    labels.insert(labels.begin() + 5, 0);
    EXPECT_EQ(column(labelled("18"), "label"), labels);
    EXPECT_THAT(column(labelled("18"), "y"), AllOf(Contains(7), Contains(8)));
}

TEST_P(CloudOutputTest, WritesPacketRingsAndTimes) {
    conversion_.input = writeRawlog({test::poleScanFrom(0, "lidar")});
    convertCounting();
    const PointTable output = labelled("000000");
    EXPECT_EQ(namesOf(output), "x, y, z, intensity, time, ring, label, obstacle");
    const Scan& scan = observed_.scan;
    EXPECT_EQ(column(output, "ring"), std::vector<double>(scan.row.begin(), scan.row.end()));
    EXPECT_EQ(column(output, "time"), std::vector<double>(scan.time_s.begin(), scan.time_s.end()));
}

TEST_P(CloudOutputTest, OmitsRingsForClouds) {
    conversion_.input = writeRawlog(
        {observations::observationOf(observed_.scan, "lidar", mrpt::Clock::fromDouble(1))});
    convertCounting();
    EXPECT_EQ(namesOf(labelled("000000")), "x, y, z, intensity, label, obstacle");
}

TEST_P(CloudOutputTest, WritesFolderPerLidar) {
    conversion_.input = writeRawlog({test::poleScanFrom(0, "front"), test::poleScanFrom(1, "rear"),
                                     test::poleScanFrom(2, "front")});
    EXPECT_EQ(convertCounting().clouds, 3u);
    std::vector<std::string> names;
    for (const auto& file : fs::recursive_directory_iterator(conversion_.clouds)) {
        if (file.is_regular_file()) {
            names.push_back(file.path().lexically_relative(conversion_.clouds).string());
        }
    }
    const std::string ending = extensionOf(GetParam());
    EXPECT_THAT(names, UnorderedElementsAre("front/000000" + ending, "front/000001" + ending,
                                            "rear/000000" + ending, "made_by.txt"));
}

TEST_P(CloudOutputTest, ReplacesOnlyOwnOutput) {
    conversion_.input = writeRawlog({test::poleScanFrom(0, "lidar")});
    convertCounting();
    EXPECT_THAT(test::messageOf([&] { convertCounting(); }), HasSubstr("labelled exists"));
    conversion_.overwrite = true;
    convertCounting();
    folder_.write("labelled/notes.txt", "mine");
    EXPECT_THAT(test::messageOf([&] { convertCounting(); }), HasSubstr("'notes.txt'"));
    conversion_.clouds = folder_ / "in.rawlog";
    EXPECT_NE(test::messageOf([&] { convertCounting(); }), "");
    EXPECT_TRUE(fs::is_regular_file(folder_ / "in.rawlog"));
}

TEST_P(CloudOutputTest, KeepsPartialOutput) {
    fs::create_directories(folder_ / "clouds");
    writeCloud(folder_ / "clouds/1.ply", convert::OutputFormat::Ply, tableOfScan());
    folder_.write("clouds/2.ply", "ply\n");
    conversion_.input = folder_ / "clouds";
    EXPECT_THAT(test::messageOf([&] { convertCounting(); }),
                AllOf(HasSubstr("2.ply: ends within its PLY header"),
                      HasSubstr("the 1 preceding scans are in"), HasSubstr("labelled.partial")));
    EXPECT_FALSE(fs::exists(conversion_.clouds));
    EXPECT_TRUE(
        fs::exists(folder_ / "labelled.partial" / (std::string("1") + extensionOf(GetParam()))));
}

INSTANTIATE_TEST_SUITE_P(Formats, CloudOutputTest,
                         testing::Values(convert::OutputFormat::Ply, convert::OutputFormat::Pcd),
                         [](const auto& format) {
                             return std::string(extensionOf(format.param)).substr(1);
                         });

}  // namespace
}  // namespace hagen::convert
