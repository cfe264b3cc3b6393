#include <gmock/gmock.h>
#include <hagen/convert/WriteCloud.h>
#include "recordings/clouds/CloudFile.h"

#include <ctime>
#include <fstream>
#include <iterator>
#include <set>

#include "support/Program.h"

namespace hagen::convert {
namespace {

namespace fs = std::filesystem;
using observations::NumberType;
using observations::PointTable;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Numbers = std::vector<double>;

PointTable twoPoints() {
    PointTable table;
    table.points = 2;
    addColumn("my ring", NumberType::UInt16, {258, 65535}, table);
    addColumn("z", NumberType::Float64, {0.5, -0.25}, table);
    addColumn("X", NumberType::Float32, {1.5, 2.5}, table);
    addColumn("y", NumberType::Int16, {-3, 4}, table);
    addColumn("t", NumberType::UInt64, {7, 9}, table);
    addColumn("label", NumberType::UInt8, {0, 2}, table);
    return table;
}

class WriteCloudTest : public testing::TestWithParam<OutputFormat> {
 protected:
    void SetUp() override {
        file_ = folder_ / (std::string("write_cloud") + extensionOf(GetParam()));
    }

    recordings::CloudFile writeAndRead(const PointTable& table) const {
        writeCloud(file_, GetParam(), table);
        return recordings::readCloud(file_);
    }
    Numbers column(const recordings::CloudFile& cloud, const char* name) const {
        const auto* const field = findField(cloud.table, {name});
        return field == nullptr ? Numbers() : columnOf(cloud.table, *field);
    }

    const test::TemporaryFolder folder_;
    fs::path file_;
};

TEST_P(WriteCloudTest, WritesReadableClouds) {
    const recordings::CloudFile cloud = writeAndRead(twoPoints());
    EXPECT_EQ(namesOf(cloud.table), "x, y, z, my_ring, t, label");
    EXPECT_THAT(column(cloud, "x"), ElementsAre(1.5, 2.5));
    EXPECT_THAT(column(cloud, "y"), ElementsAre(-3, 4));
    EXPECT_THAT(column(cloud, "z"), ElementsAre(0.5, -0.25));
    EXPECT_THAT(column(cloud, "my_ring"), ElementsAre(258, 65535));
    EXPECT_THAT(column(cloud, "t"), ElementsAre(7, 9));
    EXPECT_THAT(column(cloud, "label"), ElementsAre(0, 2));
    EXPECT_EQ(cloud.table.fields[2].type, NumberType::Float32);
    EXPECT_EQ(cloud.table.fields[3].type, NumberType::UInt16);
    EXPECT_THAT(cloud.remarks, IsEmpty());
    EXPECT_THAT(changesWhenWritten(GetParam(), twoPoints()), IsEmpty());
}

TEST_P(WriteCloudTest, KeepsFloat64ForFarCoordinates) {
    PointTable table;
    table.points = 1;
    for (const char* const name : {"x", "y", "z"}) {
        addColumn(name, NumberType::Float64, {name[0] == 'y' ? 5e6 + 0.125 : 1}, table);
    }
    const recordings::CloudFile cloud = writeAndRead(table);
    EXPECT_EQ(cloud.table.fields[0].type, NumberType::Float32);
    EXPECT_EQ(cloud.table.fields[1].type, NumberType::Float64);
    EXPECT_THAT(column(cloud, "y"), ElementsAre(5e6 + 0.125));
}

TEST_P(WriteCloudTest, KeepsArrays) {
    PointTable table = twoPoints();
    table.fields[5] = {"pair", NumberType::UInt8, table.fields[0].offset, 2};
    const recordings::CloudFile cloud = writeAndRead(table);
    if (GetParam() == OutputFormat::Ply) {
        EXPECT_THAT(column(cloud, "pair_0"), ElementsAre(2, 255));  // from 0x0102 and 0xffff
        EXPECT_THAT(column(cloud, "pair_1"), ElementsAre(1, 255));
    } else {
        EXPECT_THAT(columnOf(cloud.table, cloud.table.fields.back(), 1), ElementsAre(1, 255));
    }
}

TEST_P(WriteCloudTest, DistinguishesEqualNames) {
    PointTable table = twoPoints();
    addColumn("my_ring", NumberType::UInt8, {3, 4}, table);
    const recordings::CloudFile cloud = writeAndRead(table);
    EXPECT_THAT(column(cloud, "my_ring_"), ElementsAre(3, 4));
}

TEST(WriteCloudNames, DistinguishManyEqualNamesInTime) {
    PointTable table;
    table.points = 1;
    for (const char* const name : {"x", "y", "z", "a_4"}) {
        addColumn(name, NumberType::UInt8, {1}, table);
    }
    constexpr std::size_t kFields = 10000;
    for (std::size_t i = 0; i < kFields; ++i) {
        table.fields.push_back({"a", NumberType::UInt8, 0, 1});
    }
    const std::clock_t start = std::clock();
    const PointTable written = tableForPointCloud2(table);
    // Takes 0.05 s, but a minute if the search restarts for each name.
    EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 5);
    std::vector<std::string> names;
    std::set<std::string> different;
    for (const auto& field : written.fields) {
        names.push_back(field.name);
        different.insert(field.name);
    }
    EXPECT_EQ(different.size(), kFields + 4);
    names.resize(9);
    EXPECT_THAT(names, ElementsAre("x", "y", "z", "a_4", "a", "a_", "a__", "a_3", "a_5"));
}

TEST_P(WriteCloudTest, WritesEmptyCloud) {
    PointTable table;
    for (const char* const name : {"x", "y", "z"}) addColumn(name, NumberType::Float32, {}, table);
    const recordings::CloudFile cloud = writeAndRead(table);
    EXPECT_EQ(cloud.table.points, 0u);
    EXPECT_EQ(namesOf(cloud.table), "x, y, z");
}

TEST_P(WriteCloudTest, ReportsWriteErrors) {
    EXPECT_THROW(writeCloud(file_ / "inside", GetParam(), twoPoints()), std::runtime_error);
    PointTable table = twoPoints();
    table.fields[3].name = "w";
    EXPECT_THROW(writeCloud(file_, GetParam(), table), std::runtime_error);
    EXPECT_FALSE(fs::exists(file_));
}

INSTANTIATE_TEST_SUITE_P(Formats, WriteCloudTest,
                         testing::Values(OutputFormat::Ply, OutputFormat::Pcd),
                         [](const auto& format) {
                             return std::string(extensionOf(format.param)).substr(1);
                         });

TEST(WriteCloud, PlyReportsRoundedIntegers) {
    PointTable table = twoPoints();
    addColumn("stamp", NumberType::UInt64, {1.7e18, 3}, table);
    EXPECT_THAT(changesWhenWritten(OutputFormat::Ply, table), ElementsAre(HasSubstr("'stamp'")));
    EXPECT_THAT(changesWhenWritten(OutputFormat::Pcd, table), IsEmpty());
}

TEST(WriteCloud, PlyMatchesFormat) {
    const test::TemporaryFolder folder;
    const fs::path file = folder / "write_cloud_bytes.ply";
    PointTable table;
    table.points = 1;
    addColumn("x", NumberType::Float32, {1}, table);
    addColumn("y", NumberType::Float32, {-2}, table);
    addColumn("z", NumberType::Float32, {0}, table);
    addColumn("label", NumberType::UInt8, {2}, table);
    writeCloud(file, OutputFormat::Ply, table);
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(text, std::string("ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
                                "property float x\nproperty float y\nproperty float z\n"
                                "property uchar label\nend_header\n") +
                        std::string("\0\0\x80\x3f\0\0\0\xc0\0\0\0\0\2", 13));
    fs::remove(file);
}

TEST(TableForPointCloud2, StartsWithAlignedCoordinates) {
    PointTable input = twoPoints();
    addColumn("ns", NumberType::Int64, {9007199254740994.0, -1}, input);
    const PointTable table = tableForPointCloud2(input);
    EXPECT_NO_THROW(check(table));
    EXPECT_EQ(namesOf(table), "x, y, z, my_ring, t, label, ns");
    EXPECT_EQ(table.points, 2u);
    for (const auto& field : table.fields) {
        EXPECT_EQ(field.offset % bytesOf(field.type), 0u) << field.name;
    }
    EXPECT_EQ(table.bytes_per_point, 40u);  // 12, 2 and 2 of padding, 8, 1 and 7 of padding, 8
    EXPECT_EQ(findField(table, {"z"})->type, NumberType::Float32);
    EXPECT_EQ(findField(table, {"my_ring"})->type, NumberType::UInt16);
    EXPECT_EQ(findField(table, {"t"})->type, NumberType::Float64);
    EXPECT_EQ(columnOf(table, *findField(table, {"y"})), (Numbers{-3, 4}));
    EXPECT_EQ(columnOf(table, *findField(table, {"my_ring"})), (Numbers{258, 65535}));
    EXPECT_EQ(columnOf(table, *findField(table, {"t"})), (Numbers{7, 9}));
    EXPECT_EQ(columnOf(table, *findField(table, {"label"})), (Numbers{0, 2}));
    EXPECT_THAT(changesInPointCloud2(input),
                ElementsAre("the field 'ns' is int64, which PointCloud2 does not support: "
                            "rounded to float64"));
    PointTable flat;
    flat.points = 1;
    addColumn("x", NumberType::Float32, {0}, flat);
    EXPECT_THROW(tableForPointCloud2(flat), std::runtime_error);
}

}  // namespace
}  // namespace hagen::convert
