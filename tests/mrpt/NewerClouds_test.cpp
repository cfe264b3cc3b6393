// Clouds in the formats of MRPT 2.15 to 3. Their bytes are handwritten or derived from the
// installed MRPT.
#include <gmock/gmock.h>
#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/NewerClouds.h>
#include <hagen/mrpt/ObservationScan.h>
#include <mrpt/core/aligned_std_vector.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/stl_serialization.h>

#include "support/PointColumn.h"
#include "support/Program.h"
#include "support/Random.h"
#include "support/RawBytes.h"
#include "support/RotatingScans.h"

namespace hagen::observations {
namespace {

using test::bytesOf;
using test::column;
using test::raw;
using testing::ElementsAre;
using testing::SizeIs;
using testing::UnorderedElementsAre;
using testing::UnorderedElementsAreArray;

const auto read = test::objectOf;

std::string rawText(const std::string& text) {
    return raw(static_cast<std::uint32_t>(text.size())) + text;
}

/// The options after the fields: insertion (without `disableDeletion`) and likelihood.
std::string options() {
    return raw(std::int8_t{1}) + raw(0.02f) + std::string("\x01\0\0\0", 4) + raw(0.001f) +
           raw(2.0f) + std::string("\0", 1) + raw(std::int8_t{0}) + raw(0.0025) + raw(1.0) +
           raw(std::uint32_t{10});
}

template <class Number>
std::string field(const std::string& name, const std::vector<Number>& values) {
    return rawText(name) + raw(static_cast<std::uint32_t>(values.size())) + raw(values);
}

std::string objectOf(const std::string& name, int version, const std::string& content) {
    return static_cast<char>(0x80 | static_cast<int>(name.size())) + name +
           static_cast<char>(version) + content + '\x88';
}

std::string coordinates() {
    return raw(std::uint32_t{2}) + raw(std::vector<float>{1, 2}) + raw(std::vector<float>{3, 4}) +
           raw(std::vector<float>{5, 6});
}

const std::string kNone = raw(std::uint32_t{0});
const std::string kOne = raw(std::uint32_t{1});
const std::string kGeneric = "mrpt::maps::CGenericPointsMap";

/// A cloud of two points with a field of each type.
std::string genericCloud() {
    return objectOf(
        kGeneric, 4,
        coordinates() + raw(std::uint32_t{2}) + field<float>("intensity", {0.25f, 0.75f}) +
            field<float>("t", {0, 0.1f}) + kOne + field<double>("gps_time", {1, 2}) + kOne +
            field<std::uint16_t>("ring", {7, 8}) + kOne + field<std::uint8_t>("color_r", {255, 0}) +
            kOne + field<std::uint32_t>("rgba", {1, 2}) + options());
}

void expectTwoPoints(const mrpt::serialization::CSerializable& object) {
    const auto* cloud = dynamic_cast<const mrpt::maps::CPointsMap*>(&object);
    ASSERT_NE(cloud, nullptr);
    EXPECT_THAT(cloud->getPointsBufferRef_x(), ElementsAre(1, 2));
    EXPECT_THAT(cloud->getPointsBufferRef_y(), ElementsAre(3, 4));
    EXPECT_THAT(cloud->getPointsBufferRef_z(), ElementsAre(5, 6));
}

/// A cloud of version 2, which contains vectors written by MRPT.
std::string cloudWithVectors() {
    const auto vector = [](const auto& values) {
        mrpt::io::CMemoryStream stream;
        auto archive = mrpt::serialization::archiveFrom(stream);
        archive << values;
        return std::string(static_cast<const char*>(stream.getRawBufferData()),
                           static_cast<std::size_t>(stream.getTotalBytesCount()));
    };
    return objectOf(
        kGeneric, 2,
        coordinates() + kNone + kOne + rawText("gps_time") +
            vector(mrpt::aligned_std_vector<double>{1.5, 2.5}) + kOne + rawText("ring") +
            vector(mrpt::aligned_std_vector<std::uint16_t>{7, 65535}) + kNone + options());
}

TEST(NewerClouds, ConvertsGenericClouds) {
    const auto object = read(genericCloud());
    expectTwoPoints(*object);
    const auto cloud = std::dynamic_pointer_cast<mrpt::maps::CPointsMap>(object);
    ASSERT_NE(cloud, nullptr);
    EXPECT_THAT(*intensitiesOf(*cloud), ElementsAre(0.25f, 0.75f));
    const std::vector<std::string> names{"t", "gps_time", "ring", "color_r", "rgba"};
    EXPECT_THAT(fieldsNotKept(*cloud), UnorderedElementsAreArray(names));
    const PointTable others = otherFieldsOf(*cloud).value();
    EXPECT_THAT(column(others, "t"), ElementsAre(0, 0.1f));
    EXPECT_THAT(column(others, "gps_time"), ElementsAre(1, 2));
    EXPECT_THAT(column(others, "ring"), ElementsAre(7, 8));
    EXPECT_THAT(column(others, "color_r"), ElementsAre(255, 0));
    EXPECT_THAT(column(others, "rgba"), ElementsAre(1, 2));
    EXPECT_EQ(cloud->likelihoodOptions.decimation, 10u);

    const std::string written = bytesOf(*cloud);
    const std::string name = CLASS_ID(IntensityCloud)->className;
    EXPECT_EQ(written.substr(1, name.size()), name);
    const auto again = std::dynamic_pointer_cast<mrpt::maps::CPointsMap>(read(written));
    ASSERT_NE(again, nullptr);
    expectTwoPoints(*again);
    EXPECT_THAT(*intensitiesOf(*again), ElementsAre(0.25f, 0.75f));
    const std::size_t fields_written = MRPT_VERSION < 0x020f00 ? 0 : 5;
    EXPECT_THAT(fieldsNotKept(*again), SizeIs(fields_written));
}

TEST(NewerClouds, ReadsAllGenericVersions) {
    const std::string ring = field<std::uint16_t>("ring", {7, 8});
    expectTwoPoints(*read(
        objectOf(kGeneric, 3, coordinates() + kNone + kNone + kOne + ring + kNone + options())));
    // Before version 3, fields were written like vectors.
    const std::string times = rawText("t") + raw(std::uint32_t{2}) + raw(std::vector<float>{0, 1});
    for (const auto& [version, after] :
         {std::pair{2, kNone + kNone + kNone}, {1, kNone + kNone}, {0, kNone}}) {
        const auto object =
            read(objectOf(kGeneric, version, coordinates() + kOne + times + after + options()));
        expectTwoPoints(*object);
    }
}

/// A table with a field of each supported type, and fields of two other types.
PointTable tableOfAllTypes() {
    PointTable table;
    table.points = 2;
    addColumn("x", NumberType::Float32, {1, 2}, table);
    addColumn("y", NumberType::Float32, {3, 4}, table);
    addColumn("z", NumberType::Float32, {5, 6}, table);
    addColumn("ring", NumberType::UInt16, {7, 8}, table);
    addColumn("intensity", NumberType::Float32, {0.25, 0.75}, table);
    addColumn("t", NumberType::Float32, {0, 0.1}, table);
    addColumn("gps_time", NumberType::Float64, {1, 2}, table);
    addColumn("color_r", NumberType::UInt8, {51, 0}, table);
    addColumn("color_g", NumberType::UInt8, {102, 0}, table);
    addColumn("color_b", NumberType::UInt8, {255, 0}, table);
    addColumn("range", NumberType::UInt32, {4294967295.0, 1}, table);
    return table;
}

TEST(NewerClouds, ReportsUnusableFields) {
    const auto cloud = std::dynamic_pointer_cast<mrpt::maps::CPointsMap>(read(objectOf(
        kGeneric, 3,
        coordinates() + raw(std::uint32_t{2}) + field<float>("T", {20, 21}) +
            field<float>("t", {0, 0.1f}) + raw(std::uint32_t{2}) + field<double>("short", {1}) +
            field<double>("T", {1, 2}) + kNone + kNone + options())));
    const PointTable others = otherFieldsOf(*cloud).value();
    EXPECT_EQ(namesOf(others), "T, t");
    EXPECT_THAT(columnOf(others, others.fields[0]), ElementsAre(20, 21));
    EXPECT_THAT(fieldsNotKept(*cloud),
                ElementsAre("T", "t", "short (not kept: expected one value per point (2), found 1)",
                            "T (not kept: duplicate name)"));
    mrpt::obs::CObservationPointCloud observation;
    observation.pointcloud = cloud;
    ObservedScan observed;
    readObservation(observation, {}, observed);
    EXPECT_THAT(observed.scan.time_s, ElementsAre(0, 0.1f));  // ignores the temperature
}

#if MRPT_VERSION < 0x020f00
TEST(NewerClouds, WritesTablesAsVersion3) {
    const auto cloud = genericCloudOf(tableOfAllTypes());
    cloud->insertionOptions.horizontalTolerance = 0.001f;
    const std::string two = raw(std::uint32_t{2}), three = raw(std::uint32_t{3});
    std::string written_options = options();
    written_options[0] = 0;  // with `disableDeletion`
    written_options.insert(7, 1, '\1');
    EXPECT_EQ(bytesOf(*cloud),
              objectOf(kGeneric, 3,
                       coordinates() + two + field<float>("intensity", {0.25f, 0.75f}) +
                           field<float>("t", {0, 0.1f}) + two + field<double>("gps_time", {1, 2}) +
                           field<double>("range", {4294967295.0, 1}) + kOne +
                           field<std::uint16_t>("ring", {7, 8}) + three +
                           field<std::uint8_t>("color_r", {51, 0}) +
                           field<std::uint8_t>("color_g", {102, 0}) +
                           field<std::uint8_t>("color_b", {255, 0}) + written_options));
    EXPECT_NEAR(cloud->renderOptions.color.R, 0.2f, 1e-6);
    EXPECT_NEAR(cloud->renderOptions.color.G, 0.4f, 1e-6);
    EXPECT_NEAR(cloud->renderOptions.color.B, 1.0f, 1e-6);
}
#else
TEST(NewerClouds, FillFieldsOfMrpt) {
    const auto made = genericCloudOf(tableOfAllTypes());
    for (const mrpt::rtti::CObject::Ptr& object :
         std::vector<mrpt::rtti::CObject::Ptr>{made, read(bytesOf(*made))}) {
        const auto& cloud = dynamic_cast<const mrpt::maps::CGenericPointsMap&>(*object);
        EXPECT_EQ(cloud.getPointField_float(1, "t"), 0.1f);
#if MRPT_VERSION < 0x030000
        EXPECT_EQ(cloud.getPointField_double(0, "range"), 4294967295.0);
#else
        EXPECT_EQ(cloud.getPointField_uint32(0, "range"), 4294967295u);
#endif
        EXPECT_EQ(cloud.getPointField_uint16(1, "ring"), 8);
        EXPECT_EQ(cloud.getPointField_uint8(0, "color_g"), 102);
        mrpt::maps::CGenericPointsMap copy;
        appendPoints(cloud, {false, true}, copy);
        EXPECT_EQ(copy.size(), 1u);
        EXPECT_EQ(copy.getPointField_uint16(0, "ring"), 8);
    }
}
#endif

TEST(NewerClouds, RoundTripsGenericClouds) {
    const std::string bytes = bytesOf(*genericCloudOf(tableOfAllTypes()));
    const auto cloud = std::dynamic_pointer_cast<mrpt::maps::CPointsMap>(read(bytes));
    ASSERT_NE(cloud, nullptr);
    expectTwoPoints(*cloud);
    EXPECT_NEAR(cloud->renderOptions.color.G, 0.4f, 1e-6);
    EXPECT_THAT(fieldsNotKept(*cloud), UnorderedElementsAre("t", "gps_time", "range", "ring",
                                                            "color_r", "color_g", "color_b"));
    EXPECT_EQ(bytesOf(*cloud) == bytes, MRPT_VERSION >= 0x020f00);
    writeAsGeneric(*cloud);
    EXPECT_EQ(bytesOf(*cloud), bytes);
}

TEST(NewerClouds, SplitsMultiValueFields) {
    PointTable table = tableOfAllTypes();
    PointField& t = table.fields[5];
    ASSERT_EQ(t.name, "t");
    t.type = NumberType::UInt16;
    t.count = 2;
    const std::string bytes = bytesOf(*genericCloudOf(table));
    const auto cloud = std::dynamic_pointer_cast<mrpt::maps::CPointsMap>(read(bytes));
    const PointTable others = otherFieldsOf(*cloud).value();
    EXPECT_EQ(column(others, "t_0"), columnOf(table, t, 0));
    EXPECT_EQ(column(others, "t_1"), columnOf(table, t, 1));
}

TEST(NewerClouds, FindsRenamedIntensities) {
    PointTable table = tableOfAllTypes();
    table.fields[4].name = "scalar_Intensity";
    const auto cloud = genericCloudOf(table);
    EXPECT_THAT(*intensitiesOf(*cloud), ElementsAre(0.25f, 0.75f));
    EXPECT_EQ(column(otherFieldsOf(*cloud).value(), "scalar_Intensity"),
              column(table, "scalar_Intensity"));
}

TEST(NewerClouds, WritesChangedIntensities) {
    const auto cloud = genericCloudOf(tableOfAllTypes());
#if MRPT_VERSION < 0x020f00
    dynamic_cast<IntensityCloud&>(*cloud).setPointIntensity(1, 0.5f);
#else
    cloud->setPointField_float(1, "intensity", 0.5f);
#endif
    const auto again = std::dynamic_pointer_cast<mrpt::maps::CPointsMap>(read(bytesOf(*cloud)));
    EXPECT_THAT(*intensitiesOf(*again), ElementsAre(0.25f, 0.5f));
}

TEST(NewerClouds, RequiresCoordinates) {
    PointTable table = tableOfAllTypes();
    table.fields[1].name = "why";
    EXPECT_THROW(genericCloudOf(table), std::invalid_argument);
}

TEST(NewerClouds, ScalesIntensitiesOfAnyType) {
    const auto cloud = read(objectOf(kGeneric, 4,
                                     coordinates() + kNone + kNone + kOne +
                                         field<std::uint16_t>("intensity", {51, 255}) + kNone +
                                         kNone + options()));
    mrpt::obs::CObservationPointCloud observation;
    observation.pointcloud = std::dynamic_pointer_cast<mrpt::maps::CPointsMap>(cloud);
    ObservedScan observed;
    readObservation(observation, {}, observed);
    EXPECT_THAT(observed.scan.intensity, ElementsAre(0.2f, 1.0f));
    EXPECT_EQ(observed.remark, "");
    observation.pointcloud =
        std::dynamic_pointer_cast<mrpt::maps::CPointsMap>(read(genericCloud()));
    readObservation(observation, {}, observed);
    // Ordered by type; MRPT 2.15 has rgba as float64.
    const bool is_2_15 = MRPT_VERSION >= 0x020f00 && MRPT_VERSION < 0x030000;
    EXPECT_EQ(observed.remark,
              "the filter ignores these cloud fields; --cloud generic, --clouds and "
              "--mcap keep them: gps_time, " +
                  std::string(is_2_15 ? "rgba, ring, color_r" : "ring, color_r, rgba"));
    EXPECT_THAT(observed.scan.time_s, ElementsAre(0, 0.1f));
}

/// A simple cloud as written by the installed MRPT, and with the options before or since 2.15.3.
std::pair<std::string, std::string> simpleClouds() {
    PortableCloud cloud;
    test::Random random(3);
    for (int i = 0; i < 50; ++i) {
        cloud.insertPoint(random.real(-50, 50), random.real(-50, 50), random.real(-5, 5));
    }
    cloud.insertionOptions.isPlanarMap = true;
    cloud.renderOptions.point_size = 3;
    const std::string bytes = bytesOf(cloud);
    std::string written = raw(std::int8_t{0}) + raw(0.02f) + std::string("\x01\0\x01\0\x01", 5);
    std::string other = raw(std::int8_t{1}) + raw(0.02f) + std::string("\x01\0\0\x01", 4);
    if (bytes.find(written) == std::string::npos) std::swap(written, other);
    std::string with_other = bytes;
    return {bytes, with_other.replace(bytes.find(written), written.size(), other)};
}

TEST(NewerClouds, ReadsOtherSimpleClouds) {
    const auto [written, other] = simpleClouds();
    for (const std::string& bytes : {written, other}) {
        const auto object = read(bytes);
        ASSERT_TRUE(std::dynamic_pointer_cast<PortableCloud>(object));
        EXPECT_EQ(bytesOf(*object), written);
    }
}

TEST(NewerClouds, RejectsUnknownVersions) {
    std::string generic = genericCloud(), simple = simpleClouds().first;
    generic[1 + kGeneric.size()] = 5;
    simple[1 + std::string("mrpt::maps::CSimplePointsMap").size()] = 11;
    for (const std::string& bytes : {generic, simple}) {
        EXPECT_THAT(test::messageOf<std::exception>([&] { read(bytes); }),
                    testing::HasSubstr("ersion"));
    }
}

TEST(NewerClouds, RejectsTruncatedClouds) {
    std::vector<std::string> clouds{genericCloud(), cloudWithVectors()};
    if (MRPT_VERSION < 0x020f00) clouds.push_back(simpleClouds().second);  // later read by MRPT
    for (const std::string& whole : clouds) {
        for (std::size_t size = 0; size < whole.size(); ++size) {
            EXPECT_ANY_THROW(read(whole.substr(0, size))) << size;
        }
    }
}

TEST(NewerClouds, LimitsMemoryForPointCounts) {
    std::string bytes = genericCloud();
    bytes.replace(bytes.find(coordinates()), 4, raw(std::uint32_t{0xffffffff}));
    EXPECT_ANY_THROW(read(bytes));
}

TEST(NewerClouds, ReadsMrptVectors) {
    const auto object = read(cloudWithVectors());
    expectTwoPoints(*object);
    const PointTable others =
        otherFieldsOf(dynamic_cast<const mrpt::maps::CPointsMap&>(*object)).value();
    EXPECT_EQ(namesOf(others), "gps_time, ring");
    EXPECT_THAT(column(others, "gps_time"), ElementsAre(1.5, 2.5));
    EXPECT_THAT(column(others, "ring"), ElementsAre(7, 65535));
}

TEST(NewerClouds, LimitsMemoryForValueCounts) {
    const std::string whole = cloudWithVectors();
    for (const std::string before : {"double", "uint16_t", "gps_time", "ring"}) {
        std::string bytes = whole;
        // A type name precedes the number of values, a field name the number of characters.
        bytes.replace(bytes.find(before) + before.size(), 4, raw(std::uint32_t{0xffffffff}));
        EXPECT_THAT(test::messageOf<std::exception>([&] { read(bytes); }),
                    testing::Not(testing::AnyOf("", testing::HasSubstr("std::bad_"))))
            << before;
    }
}

}  // namespace
}  // namespace hagen::observations
