// Uses the Point Cloud Library (PCL) as an independent reader and writer.
#include <gmock/gmock.h>
#include <hagen/convert/WriteCloud.h>
#include <pcl/PCLPointCloud2.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>
#include "recordings/clouds/CloudFile.h"

#include <cstring>
#include <limits>

#include "support/Program.h"

namespace hagen::recordings {
namespace {

namespace fs = std::filesystem;
using observations::NumberType;
using observations::PointTable;

std::vector<double> column(const PointTable& table, const char* name) {
    const auto* const field = findField(table, {name});
    EXPECT_NE(field, nullptr) << name;
    return field == nullptr ? std::vector<double>() : columnOf(table, *field);
}

class PclFilesTest : public testing::Test {
 protected:
    PclFilesTest() {
        for (int i = 0; i < 500; ++i) {
            pcl::PointXYZI point;
            point.x = 0.37f * static_cast<float>(i);
            point.y = i == 7 ? std::numeric_limits<float>::quiet_NaN() : -1e-3f;
            point.z = static_cast<float>(i % 16);
            point.intensity = static_cast<float>(i % 3);
            cloud_.push_back(point);
        }
        cloud_.is_dense = false;
    }
    ~PclFilesTest() override { fs::remove(file_); }

    void expectPoints() const {
        const CloudFile read = readCloud(file_);
        ASSERT_EQ(read.table.points, cloud_.size());
        const auto x = column(read.table, "x"), y = column(read.table, "y"),
                   z = column(read.table, "z"), intensity = column(read.table, "intensity");
        for (std::size_t i = 0; i < cloud_.size(); ++i) {
            ASSERT_FLOAT_EQ(static_cast<float>(x[i]), cloud_[i].x);
            ASSERT_EQ(std::isnan(y[i]), std::isnan(cloud_[i].y));
            if (i != 7) {
                ASSERT_FLOAT_EQ(static_cast<float>(y[i]), cloud_[i].y);
            }
            ASSERT_FLOAT_EQ(static_cast<float>(z[i]), cloud_[i].z);
            ASSERT_FLOAT_EQ(static_cast<float>(intensity[i]), cloud_[i].intensity);
        }
    }

    const test::TemporaryFolder folder_;
    const std::string file_ = (folder_ / "hagen_pcl_file").string();
    pcl::PointCloud<pcl::PointXYZI> cloud_;
};

TEST_F(PclFilesTest, ReadsPclPcdFiles) {
    ASSERT_EQ(pcl::io::savePCDFileASCII(file_, cloud_), 0);
    expectPoints();
    ASSERT_EQ(pcl::io::savePCDFileBinary(file_, cloud_), 0);
    expectPoints();
    ASSERT_EQ(pcl::io::savePCDFileBinaryCompressed(file_, cloud_), 0);
    expectPoints();
    cloud_.width = 50;  // an organised cloud
    cloud_.height = 10;
    ASSERT_EQ(pcl::io::savePCDFileBinaryCompressed(file_, cloud_), 0);
    expectPoints();
}

TEST_F(PclFilesTest, ReadsPclPlyFiles) {
    ASSERT_EQ(pcl::io::savePLYFileASCII(file_, cloud_), 0);
    expectPoints();
    ASSERT_EQ(pcl::io::savePLYFileBinary(file_, cloud_), 0);
    expectPoints();
}

TEST_F(PclFilesTest, WritesFilesReadableByPcl) {
    PointTable table;
    table.points = 3;
    addColumn("x", NumberType::Float64, {1.5, -2, 3}, table);
    addColumn("y", NumberType::Float32, {0.25, 0, 7}, table);
    addColumn("z", NumberType::Float32, {9, 8, 6}, table);
    addColumn("intensity", NumberType::Float32, {0.5, 1, 0}, table);
    addColumn("ring", NumberType::UInt16, {258, 3, 65535}, table);
    addColumn("t", NumberType::Float64, {0.125, 1e9, 3}, table);
    addColumn("label", NumberType::UInt8, {0, 1, 2}, table);
    addColumn("obstacle", NumberType::UInt32, {70000, 4000000000.0, 0}, table);
    for (const convert::OutputFormat format :
         {convert::OutputFormat::Pcd, convert::OutputFormat::Ply}) {
        SCOPED_TRACE(extensionOf(format));
        writeCloud(file_, format, table);
        pcl::PCLPointCloud2 read;
        ASSERT_EQ(format == convert::OutputFormat::Pcd ? pcl::io::loadPCDFile(file_, read)
                                                       : pcl::io::loadPLYFile(file_, read),
                  0);
        ASSERT_EQ(read.width * read.height, 3u);
        const auto number = [&](const char* name, std::size_t i, auto type) {
            for (const auto& field : read.fields) {
                if (field.name != name) continue;
                std::memcpy(&type, &read.data[i * read.point_step + field.offset], sizeof type);
                EXPECT_EQ(field.count, 1u);
                return static_cast<double>(type);
            }
            ADD_FAILURE() << name;
            return 0.0;
        };
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(number("x", i, float()), column(table, "x")[i]);
            EXPECT_EQ(number("intensity", i, float()), column(table, "intensity")[i]);
            EXPECT_EQ(number("ring", i, std::uint16_t()), column(table, "ring")[i]);
            EXPECT_EQ(number("t", i, double()), column(table, "t")[i]);
            EXPECT_EQ(number("label", i, std::uint8_t()), column(table, "label")[i]);
            EXPECT_EQ(number("obstacle", i, std::uint32_t()), column(table, "obstacle")[i]);
        }
        pcl::PointCloud<pcl::PointXYZI> points;
        pcl::fromPCLPointCloud2(read, points);
        EXPECT_EQ(points[1].x, -2.0f);
        EXPECT_EQ(points[2].y, 7.0f);
        EXPECT_EQ(points[0].intensity, 0.5f);
    }
}

}  // namespace
}  // namespace hagen::recordings
