// Rawlogs whose clouds carry all fields (`--cloud generic`).
#include <gmock/gmock.h>
#include <hagen/convert/Conversion.h>
#include <hagen/convert/WriteCloud.h>
#include <hagen/mrpt/NewerClouds.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/RawlogReader.h>
#include <mrpt/obs/CSensoryFrame.h>
#include "convert/RawlogWriter.h"
#include "mrpt/Results.h"
#include "mrpt/TableCloud.h"
#include "recordings/clouds/CloudFile.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "support/PointColumn.h"
#include "support/Program.h"
#include "support/SimpleFirings.h"

namespace hagen::convert {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservationPointCloud;
using observations::NumberType;
using observations::PointTable;
using test::column;
using testing::Each;
using testing::ElementsAreArray;
using testing::HasSubstr;

CObservationPointCloud::Ptr asCloud(const mrpt::serialization::CSerializable::Ptr& entry) {
    auto cloud = std::dynamic_pointer_cast<CObservationPointCloud>(entry);
    EXPECT_TRUE(cloud && cloud->pointcloud);
    return cloud;
}

/// The additional fields of a cloud read as a generic cloud.
PointTable fieldsOf(const CObservationPointCloud& observation) {
    return observations::otherFieldsOf(*observation.pointcloud).value();
}

std::vector<mrpt::serialization::CSerializable::Ptr> entriesOf(const fs::path& file) {
    std::vector<mrpt::serialization::CSerializable::Ptr> entries;
    recordings::RawlogReader reader(file);
    while (auto entry = reader.next()) entries.push_back(entry);
    return entries;
}

class GenericClouds : public testing::Test {
 protected:
    GenericClouds() {
        conversion_.input = folder_ / "in.rawlog";
        conversion_.rawlog = folder_ / "out.rawlog";
        conversion_.cloud_class = observations::CloudClass::Generic;
        conversion_.settings.sensor.model = "VLP-16";
    }
    void write(const std::vector<mrpt::serialization::CSerializable::Ptr>& entries) const {
        RawlogWriter writer(conversion_.input, true);
        for (const auto& entry : entries) writer.write(*entry);
        writer.commit();
    }
    /// Converts the output again and expects an equal file.
    void expectSameAgain() const {
        Conversion again = conversion_;
        again.input = conversion_.rawlog;
        again.rawlog = folder_ / "again.rawlog";
        EXPECT_GT(convert(again).results_replaced, 0u);
        EXPECT_EQ(test::readFile(again.rawlog), test::readFile(conversion_.rawlog));
    }

    test::TemporaryFolder folder_;
    Conversion conversion_;
};

TEST_F(GenericClouds, KeepFieldsInResults) {
    write({test::poleScanFrom(0, "lidar")});
    conversion_.clouds = folder_ / "labelled";
    convert(conversion_);
    const PointTable all = recordings::readCloud(folder_ / "labelled/000000.ply").table;
    const auto entries = entriesOf(conversion_.rawlog);
    ASSERT_EQ(entries.size(), 3u);
    for (const bool is_roi : {true, false}) {
        const auto result = asCloud(entries[is_roi ? 1 : 2]);
        EXPECT_TRUE(observations::isResult(*result));
        const PointTable& fields = fieldsOf(*result);
        const auto points = result->pointcloud->size();
        ASSERT_GT(points, 80u);
        EXPECT_THAT(column(fields, "label"), Each(is_roi ? 2 : 1));
        const auto& color = is_roi ? observations::kRoiColor : observations::kNonRoiColor;
        EXPECT_THAT(column(fields, "color_r"), Each(color.R));
        EXPECT_THAT(column(fields, "color_g"), Each(color.G));
        EXPECT_THAT(column(fields, "color_b"), Each(color.B));

        // Points with this label, in the order of the labelled cloud.
        const auto labels = column(all, "label");
        for (const auto& [name, in_cloud] :
             {std::pair{"obstacle", "obstacle"}, {"ring", "ring"}, {"t", "time"}}) {
            std::vector<double> expected;
            const auto values = column(all, in_cloud);
            for (std::size_t i = 0; i < labels.size(); ++i) {
                if (labels[i] == (is_roi ? 2 : 1)) expected.push_back(values[i]);
            }
            EXPECT_THAT(column(fields, name), ElementsAreArray(expected)) << name;
        }
    }
}

TEST_F(GenericClouds, ReproduceOwnOutput) {
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(test::poleScanFrom(1, "rear"));
    write({test::poleScanFrom(0, "lidar"), frame});
    conversion_.preview = true;
    convert(conversion_);
    expectSameAgain();

    conversion_.settings.options.zone_m = 0.2f;  // all returns are beyond the zone
    conversion_.settings.options.context_m = 0.3f;
    conversion_.overwrite = true;
    conversion_.preview = false;
    EXPECT_EQ(convert(conversion_).roi, 0u);
    expectSameAgain();
}

TEST_F(GenericClouds, KeepFieldsFromFiles) {
    observations::ObservedScan observed;
    observations::readObservation(*test::poleScanFrom(0, "lidar"), {}, observed);
    PointTable input = observations::tableOf(observed.scan);
    std::vector<double> numbers(input.points), colors(input.points, 9);
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>(70000 + i);
    addColumn("range_mm", NumberType::UInt32, numbers, input);
    addColumn("color_r", NumberType::UInt8, colors, input);
    conversion_.input = folder_ / "17.pcd";
    writeCloud(conversion_.input, convert::OutputFormat::Pcd, input);
    convert(conversion_);
    const auto entries = entriesOf(conversion_.rawlog);
    ASSERT_EQ(entries.size(), 3u);
    EXPECT_THAT(column(fieldsOf(*asCloud(entries[0])), "range_mm"), ElementsAreArray(numbers));
    std::vector<double> of_results;
    for (const std::size_t i : {1u, 2u}) {
        const PointTable& fields = fieldsOf(*asCloud(entries[i]));
        const auto some = column(fields, "range_mm");
        of_results.insert(of_results.end(), some.begin(), some.end());
        EXPECT_THAT(column(fields, "input_color_r"), Each(9));
    }
    std::sort(of_results.begin(), of_results.end());
    EXPECT_EQ(std::adjacent_find(of_results.begin(), of_results.end()), of_results.end());
    EXPECT_GT(of_results.size(), numbers.size() / 2);
}

TEST_F(GenericClouds, HaveUniqueFieldNames) {
    observations::ObservedScan observed;
    observations::readObservation(*test::poleScanFrom(0, "lidar"), {}, observed);
    PointTable input = observations::tableOf(observed.scan);
    double value = 60;
    for (const char* const name :
         {"label", "input_label", "obstacle", "input_obstacle", "color_r", "input_color_r"}) {
        addColumn(name, NumberType::UInt8, std::vector<double>(input.points, ++value), input);
    }
    conversion_.input = folder_ / "17.pcd";
    writeCloud(conversion_.input, convert::OutputFormat::Pcd, input);
    conversion_.clouds = folder_ / "labelled";
    std::string remarks;
    ConversionListener listener;
    listener.remark = [&](const std::string&, const std::string& text) { remarks += text + "\n"; };
    convert(conversion_, listener);
    const PointTable labelled = recordings::readCloud(folder_ / "labelled/17.ply").table;
    const auto entries = entriesOf(conversion_.rawlog);
    ASSERT_EQ(entries.size(), 3u);
    const PointTable& result = fieldsOf(*asCloud(entries[1]));
    const std::set<std::string> names = [&] {
        std::set<std::string> different;
        for (const auto& field : result.fields) different.insert(field.name);
        return different;
    }();
    EXPECT_EQ(names.size(), result.fields.size()) << namesOf(result);
    for (const PointTable* const table : {&result, &labelled}) {
        EXPECT_THAT(column(*table, "input_label_"), Each(61));
        EXPECT_THAT(column(*table, "input_label"), Each(62));
        EXPECT_THAT(column(*table, "input_obstacle_"), Each(63));
        EXPECT_THAT(column(*table, "input_obstacle"), Each(64));
    }
    EXPECT_THAT(column(result, "input_color_r_"), Each(65));
    EXPECT_THAT(column(result, "input_color_r"), Each(66));
    EXPECT_THAT(remarks, HasSubstr("renamed to 'input_label_'"));
    EXPECT_THAT(remarks, testing::Not(HasSubstr("renamed to 'input_label'")));
}

TEST_F(GenericClouds, AreOptional) {
    write({test::poleScanFrom(0, "lidar")});
    convert(conversion_);
    conversion_.input = conversion_.rawlog;
    conversion_.rawlog = folder_ / "simple.rawlog";
    conversion_.cloud_class = observations::CloudClass::Simple;
    convert(conversion_);
    for (const auto& entry : entriesOf(conversion_.rawlog)) {
        const auto cloud = std::dynamic_pointer_cast<CObservationPointCloud>(entry);
        if (!cloud) continue;
        EXPECT_FALSE(observations::otherFieldsOf(*cloud->pointcloud));
    }
}

// MRPT 3 wrote the sample; its fields and bytes are preserved.
TEST_F(GenericClouds, KeepMrpt3Cloud) {
    const char* const folder = std::getenv("HAGEN_MRPT3_DATA");
    if (folder == nullptr) GTEST_SKIP() << "HAGEN_MRPT3_DATA is not set (see CONTRIBUTING.md)";
    conversion_.input = fs::path(folder) / "sample_mrpt3.rawlog";
    conversion_.settings.sensor.model.reset();
    convert(conversion_);
    const auto before = entriesOf(conversion_.input), after = entriesOf(conversion_.rawlog);
    std::size_t clouds = 0;
    for (const auto& entry : before) {
        const auto cloud = std::dynamic_pointer_cast<CObservationPointCloud>(entry);
        if (!cloud || !observations::otherFieldsOf(*cloud->pointcloud)) continue;
        const auto same = std::find_if(after.begin(), after.end(), [&](const auto& other) {
            const auto written = std::dynamic_pointer_cast<CObservationPointCloud>(other);
            return written && written->sensorLabel == cloud->sensorLabel &&
                   written->timestamp == cloud->timestamp;
        });
        ASSERT_NE(same, after.end());
        const PointTable fields = fieldsOf(*cloud), written = fieldsOf(*asCloud(*same));
        EXPECT_EQ(namesOf(written), namesOf(fields));
        EXPECT_EQ(written.bytes, fields.bytes);
        ++clouds;
    }
    EXPECT_GT(clouds, 0u);
    conversion_.overwrite = true;
    expectSameAgain();
}

}  // namespace
}  // namespace hagen::convert
