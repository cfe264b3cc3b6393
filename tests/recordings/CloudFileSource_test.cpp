#include <gmock/gmock.h>
#include <hagen/recordings/ScanFolder.h>
#include <hagen/recordings/ScanSource.h>
#include "mrpt/TableCloud.h"
#include "recordings/PoseFile.h"

#include "support/CloudFiles.h"
#include "support/Program.h"

namespace hagen::recordings {
namespace {

namespace fs = std::filesystem;
using test::filePoints;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class CloudFileSourceTest : public testing::Test {
 protected:
    fs::path write(const std::string& name, const std::string& text) const {
        fs::create_directories((folder_ / name).parent_path());
        test::writeFile(folder_ / name, text);
        return folder_ / name;
    }
    /// Creates a folder of clouds with these names.
    fs::path folderOf(const std::vector<std::string>& names) const {
        for (const std::string& name : names) write("clouds/" + name, test::bin(filePoints()));
        return folder_ / "clouds";
    }
    /// Names and times of the scans.
    static std::pair<std::vector<std::string>, std::vector<double>> scansOf(const fs::path& input) {
        std::pair<std::vector<std::string>, std::vector<double>> scans;
        const auto source = openRecording(input);
        while (const auto scan = source->nextScan()) {
            scans.first.push_back(scan->name);
            scans.second.push_back(mrpt::Clock::toDouble(scan->observation->timestamp));
        }
        return scans;
    }
    std::vector<std::string> remarksOn(const fs::path& input,
                                       const SourceOptions& options = {}) const {
        const auto source = openRecording(input, options);
        while (source->nextEntry()) {
        }
        return source->remarks();
    }

    test::TemporaryFolder folder_;
};

TEST_F(CloudFileSourceTest, ReadsEveryFormat) {
    for (const auto& [name, text] : test::cloudFiles()) {
        SCOPED_TRACE(name);
        const auto source = openRecording(write(name, text));
        const auto entry = source->nextEntry();
        ASSERT_TRUE(entry);
        ASSERT_EQ(entry->scans.size(), 1u);
        EXPECT_EQ(entry->object, nullptr);
        EXPECT_EQ(entry->scans[0].name, name.substr(0, name.find('.')));
        EXPECT_EQ(entry->scans[0].observation->sensorLabel, "lidar");
        const auto* const cloud = observations::tableCloudOf(*entry->scans[0].observation);
        ASSERT_NE(cloud, nullptr);
        EXPECT_FLOAT_EQ(cloud->getPointsBufferRef_y()[2], -4.5f);
        EXPECT_EQ(entry->fraction_read, 1.0);
        EXPECT_FALSE(source->nextEntry());
    }
}

TEST_F(CloudFileSourceTest, ReadsFilesByNumber) {
    const auto [names, times] = scansOf(folderOf({"a_10.bin", "a_9.bin", "a_11.bin"}));
    EXPECT_THAT(names, ElementsAre("a_9", "a_10", "a_11"));
    EXPECT_THAT(times, ElementsAre(testing::DoubleNear(0.9, 1e-6), testing::DoubleNear(1.0, 1e-6),
                                   testing::DoubleNear(1.1, 1e-6)));
}

/// A separator is part of the following number only after another number.
TEST_F(CloudFileSourceTest, AcceptsSeparatorsBeforeNumbers) {
    for (const std::string before : {"scan.", "_", "left_"}) {
        SCOPED_TRACE(before);
        const fs::path folder = folderOf({before + "10.bin", before + "9.bin"});
        const auto [names, times] = scansOf(folder);
        EXPECT_THAT(names, ElementsAre(before + "9", before + "10"));
        EXPECT_THAT(times,
                    ElementsAre(testing::DoubleNear(0.9, 1e-6), testing::DoubleNear(1.0, 1e-6)));
        fs::remove_all(folder);
    }
}

TEST_F(CloudFileSourceTest, ReadsTimesFromNames) {
    const auto near = [](double time_s) { return testing::DoubleNear(time_s, 1e-6); };
    const std::vector<std::vector<std::string>> kNames{
        {"1700000000.25.bin", "1700000000.5.bin"},
        {"1700000000_250000000.bin", "1700000000_500000000.bin"},
        {"scan_1700000000.25.bin", "scan_1700000000.5.bin"},
        {"scan1700000000250.bin", "scan1700000000500.bin"},
        {"1700000000250000.bin", "1700000000500000.bin"},
        {"1700000000250000000.bin", "1700000000500000000.bin"}};
    for (const auto& names : kNames) {
        SCOPED_TRACE(names[0]);
        const fs::path folder = folderOf(names);
        EXPECT_THAT(scansOf(folder).second, ElementsAre(near(1700000000.25), near(1700000000.5)));
        EXPECT_THAT(remarksOn(folder), Contains(HasSubstr("from the file names")));
        fs::remove_all(folder);
    }
}

TEST_F(CloudFileSourceTest, AssumesPeriodWithoutTimes) {
    const std::vector<std::vector<std::string>> kNames{{"left.bin", "right.bin"},
                                                       {"0000.bin", "1.bin"},
                                                       {"1_5.bin", "front.bin"},
                                                       {"1700000000.5.bin", "7.bin"}};
    for (const auto& names : kNames) {
        SCOPED_TRACE(names[0]);
        const fs::path folder = folderOf(names);
        const std::vector<double> times = scansOf(folder).second;
        ASSERT_EQ(times.size(), 2u);
        EXPECT_THAT(remarksOn(folder), Contains(HasSubstr("assuming 0.1 s")));
        fs::remove_all(folder);
    }
    EXPECT_THAT(scansOf(folderOf({"same.bin", "same.pcd"})).second,
                ElementsAre(0.0, testing::DoubleNear(0.1, 1e-6)));
}

TEST_F(CloudFileSourceTest, ScalesNormalizedTimesByPeriod) {
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
        "property float z\nproperty float time\nend_header\n1 2 3 0\n1 2 3 0.95\n";
    const auto lastTime = [&](const std::string& name) {
        const auto scan = openRecording(folder_ / name)->nextScan();
        return observations::tableCloudOf(*scan->observation)->times_s()[1];
    };
    for (const char* const name :
         {"known/1700000000.25.ply", "known/1700000000.35.ply", "a/1.ply"}) {
        write(name, ply);
    }
    EXPECT_NEAR(lastTime("known"), 0.095, 1e-6);
    EXPECT_FLOAT_EQ(lastTime("a"), 0.95f);
    EXPECT_THAT(remarksOn(folder_ / "a"),
                ElementsAre(AllOf(HasSubstr("assuming 0.1 s"), HasSubstr("the field 'time' times")),
                            HasSubstr("'time' spans 0 to 1")));
    EXPECT_THAT(remarksOn(folder_ / "known"), ElementsAre(HasSubstr("from the file names")));
}

TEST_F(CloudFileSourceTest, ReadsPaddedNumbersAsCounters) {
    const std::vector<std::vector<std::string>> kNames{
        {"0000000000.bin", "0000000001.bin"},  // as in KITTI's raw recordings
        {"0000000000000.bin", "0000000000001.bin"},
        {"vlp16.000001.bin", "vlp16.000002.bin"},
        {"hdl_64.000001.bin", "hdl_64.000002.bin"},
        {"1700000000_000012.bin", "1700000000_000013.bin"}};
    for (const auto& names : kNames) {
        SCOPED_TRACE(names[0]);
        const fs::path folder = folderOf(names);
        EXPECT_THAT(remarksOn(folder), Contains(HasSubstr("assuming 0.1 s")));
        const auto [scans, times] = scansOf(folder);
        EXPECT_THAT(scans, ElementsAre(fs::path(names[0]).stem(), fs::path(names[1]).stem()));
        EXPECT_THAT(times, ElementsAre(0.0, testing::DoubleNear(0.1, 1e-6)));
        fs::remove_all(folder);
    }
}

TEST_F(CloudFileSourceTest, AcceptsUnpaddedNanoseconds) {
    const fs::path folder =
        folderOf({"1700000001_50000000.bin", "1700000000_950000000.bin", "1700000001_5.bin"});
    const auto [names, times] = scansOf(folder);
    EXPECT_THAT(names, ElementsAre("1700000000_950000000", "1700000001_5", "1700000001_50000000"));
    const auto near = [](double time_s) { return testing::DoubleNear(time_s, 1e-6); };
    EXPECT_THAT(times, ElementsAre(near(1700000000.95), near(1700000001.0), near(1700000001.05)));
    EXPECT_THAT(remarksOn(folder), Contains(HasSubstr("from the file names")));
}

TEST_F(CloudFileSourceTest, ReadsNuScenes) {
    write("clouds/day__LIDAR_TOP__1532402927647951.pcd.bin", test::binWithRings(filePoints(20)));
    write("clouds/day__LIDAR_TOP__1532402927697951.pcd.bin", test::binWithRings(filePoints(20)));
    const auto [names, times] = scansOf(folder_ / "clouds");
    EXPECT_THAT(names, ElementsAre("day__LIDAR_TOP__1532402927647951", HasSubstr("7951")));
    EXPECT_THAT(times, ElementsAre(testing::DoubleNear(1532402927.647951, 1e-6),
                                   testing::DoubleNear(1532402927.697951, 1e-6)));
    const auto scan = openRecording(folder_ / "clouds")->nextScan();
    const auto& rings = observations::tableCloudOf(*scan->observation)->rings();
    ASSERT_EQ(rings.size(), 20u);
    EXPECT_EQ(rings[3], 3);
}

TEST_F(CloudFileSourceTest, KeepsExtensionsIfNamesAreEqual) {
    EXPECT_THAT(scansOf(folderOf({"1.bin", "1.pcd"})).first, ElementsAre("1.bin", "1.pcd"));
}

TEST_F(CloudFileSourceTest, PrefersScanFolder) {
    const fs::path folder = folderOf({"1.bin"});
    write("clouds/velodyne/000000.bin", test::bin(filePoints()));
    EXPECT_EQ(openRecording(folder)->nextScan()->observation->sensorLabel, kFolderLabel);
    // The subfolder itself is a valid folder of clouds.
    EXPECT_EQ(openRecording(folder / "velodyne")->nextScan()->observation->sensorLabel, "lidar");
}

TEST_F(CloudFileSourceTest, ReadsSelectedEntries) {
    const fs::path folder = folderOf({"1.bin", "2.bin", "3.bin", "4.bin"});
    write("clouds/1.bin", "x");  // broken, but not selected
    SourceOptions options;
    options.first_scan = 1;
    options.last_scan = 2;
    const auto source = openRecording(folder, options);
    EXPECT_EQ(source->nextScan()->name, "2");
    EXPECT_EQ(source->nextScan()->name, "3");
    EXPECT_FALSE(source->nextScan());
    EXPECT_EQ(source->entriesSkipped(), 1u);
    EXPECT_EQ(source->scansKnown(), 4u);
}

TEST_F(CloudFileSourceTest, ReportsBrokenFile) {
    const fs::path folder = folderOf({"1.bin", "3.bin"});
    write("clouds/2.pcd", test::binaryPcd(filePoints()).substr(0, 300));
    const auto source = openRecording(folder);
    EXPECT_TRUE(source->nextScan());
    EXPECT_THAT(test::messageOf<BrokenRecording>([&] { source->nextScan(); }),
                HasSubstr("2.pcd: the header claims 12 points"));
}

/// The link's target could be on an unmounted drive.
TEST_F(CloudFileSourceTest, ReportsDanglingLink) {
    const fs::path folder = folderOf({"1.bin", "3.bin"});
    fs::create_symlink("nowhere", folder / "2.bin");
    const auto source = openRecording(folder);
    EXPECT_TRUE(source->nextScan());
    EXPECT_THAT(test::messageOf([&] { source->nextScan(); }), HasSubstr("2.bin"));
}

TEST_F(CloudFileSourceTest, RejectsCloudWithoutCoordinates) {
    const fs::path file = write(
        "a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float u\nend_header\n1\n");
    const auto source = openRecording(file);
    EXPECT_THAT(test::messageOf([&] { source->nextScan(); }),
                AllOf(HasSubstr("a.ply: "), HasSubstr("fields: u")));
}

TEST_F(CloudFileSourceTest, ReportsIgnoredContent) {
    auto points = filePoints();
    points[3].x_m = std::numeric_limits<float>::quiet_NaN();
    points[5].z_m = std::numeric_limits<float>::infinity();
    write("clouds/1.npy", test::structuredNpy(points));
    write("clouds/2.las", test::las(filePoints(), true));
    write("clouds/notes.txt", "hello");
    SourceOptions options;
    options.folder_objects = observations::CloudClass::Simple;
    const auto remarks = remarksOn(folder_ / "clouds", options);
    EXPECT_THAT(remarks, Contains(HasSubstr("2 points with non-finite coordinates in 1 cloud")));
    EXPECT_THAT(remarks, Contains(AllOf(HasSubstr("4 extra bytes"), HasSubstr("(1 of 2 clouds)"))));
    EXPECT_THAT(remarks, Contains(HasSubstr("ignored 1 file without the extension")));
    EXPECT_THAT(remarks,
                Contains(HasSubstr("cannot store (--cloud generic and --clouds can): ring, t")));
    EXPECT_THAT(remarksOn(folder_ / "clouds"), Not(Contains(HasSubstr("cannot store"))));
}

TEST_F(CloudFileSourceTest, WritesReturnsToObject) {
    auto points = filePoints();
    points[3].x_m = std::numeric_limits<float>::quiet_NaN();
    SourceOptions options;
    options.folder_objects = observations::CloudClass::Simple;
    const auto entry = openRecording(write("1.pcd", test::binaryPcd(points)), options)->nextEntry();
    const auto object = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(entry->object);
    ASSERT_TRUE(object);
    EXPECT_EQ(object->pointcloud->size(), 11u);
}

TEST_F(CloudFileSourceTest, ReadsPosesFromFile) {
    const fs::path folder = folderOf({"1.bin", "2.bin"});
    writeTumPoses(folder_ / "poses.tum", {{0.1, {}}, {0.25, mrpt::poses::CPose3D(3, 0, 0)}});
    const auto source = openRecording(folder);
    source->usePoses(folder_ / "poses.tum");
    source->nextScan();
    const auto scan = source->nextScan();
    ASSERT_TRUE(scan->pose.sensor_pose);
    EXPECT_NEAR(scan->pose.sensor_pose->x(), 2.0, 1e-3);
    EXPECT_THAT(source->scanTimes().at("lidar"), testing::SizeIs(2));
}

}  // namespace
}  // namespace hagen::recordings
