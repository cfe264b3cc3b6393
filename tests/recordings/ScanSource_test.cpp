#include <gmock/gmock.h>
#include <hagen/recordings/RawlogReader.h>
#include <hagen/recordings/ScanFolder.h>
#include <hagen/recordings/ScanSource.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>
#include "convert/RawlogWriter.h"
#include "recordings/PoseFile.h"
#include "recordings/rawlogs/PackedInput.h"

#include <fstream>

#include "support/Program.h"
#include "support/SimpleFirings.h"
#include "support/SimpleScene.h"

namespace hagen::recordings {
namespace {

using mrpt::poses::CPose3D;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;
using Entries = std::vector<mrpt::serialization::CSerializable::Ptr>;

mrpt::Clock::time_point timeAt(double seconds) { return mrpt::Clock::fromDouble(1000.0 + seconds); }

/// A cloud with one return at x.
Scan returnAt(float x_m) {
    Scan scan;
    scan.x_m = {x_m};
    scan.y_m = {0};
    scan.z_m = {0};
    scan.intensity = {0.5f};
    return scan;
}

mrpt::obs::CObservationPointCloud::Ptr labelledCloud(double seconds, const std::string& label) {
    const auto observation =
        observations::observationOf(returnAt(static_cast<float>(seconds)), label, timeAt(seconds));
    observation->sensorPose = CPose3D(0, 0, 0.25, 0, 0, 0);
    return observation;
}

mrpt::obs::CObservationRobotPose::Ptr pose(double seconds, double x_m, double pitch_rad) {
    auto observation = mrpt::obs::CObservationRobotPose::Create();
    observation->timestamp = timeAt(seconds);
    observation->pose.mean = CPose3D(x_m, 0, 1, 0, pitch_rad, 0);
    return observation;
}

mrpt::obs::CSensoryFrame::Ptr frameOf(const std::vector<mrpt::obs::CObservation::Ptr>& all) {
    auto frame = mrpt::obs::CSensoryFrame::Create();
    for (const auto& observation : all) frame->insert(observation);
    return frame;
}

/// "entry:label:seconds" of every scan of the source.
std::vector<std::string> pulledFrom(ScanSource& source) {
    std::vector<std::string> pulled;
    while (const auto scan = source.nextScan()) {
        const double time_s = mrpt::Clock::toDouble(scan->observation->timestamp) - 1000.0;
        pulled.push_back(std::to_string(scan->entry) + ":" + scan->observation->sensorLabel + ":" +
                         std::to_string(static_cast<int>(std::lround(time_s))));
    }
    return pulled;
}

class ScanSourceTest : public testing::Test {
 protected:
    fs::path rawlogOf(const Entries& entries) const {
        convert::RawlogWriter writer(folder_ / "a.rawlog", true);
        for (const auto& entry : entries) writer.write(*entry);
        writer.commit();
        return folder_ / "a.rawlog";
    }
    fs::path scanFolderOf(int scans, const std::string& times = "") const {
        const fs::path path = folder_ / "scans";
        fs::create_directories(path / "velodyne");
        for (int i = 0; i < scans; ++i) {
            writeScan(path / "velodyne" / ("00000" + std::to_string(i) + ".bin"),
                      returnAt(static_cast<float>(i)));
        }
        if (!times.empty()) std::ofstream(path / "times.txt") << times;
        return path;
    }
    /// Entries with two LiDARs, a comment, and a frame with one scan per LiDAR.
    Entries mixed() const {
        auto comment = mrpt::obs::CObservationComment::Create();
        return {labelledCloud(1, "front"), comment,
                frameOf({labelledCloud(3, "front"), labelledCloud(4, "rear")}),
                labelledCloud(5, "rear"), labelledCloud(6, "front")};
    }
    test::TemporaryFolder folder_;
};

TEST_F(ScanSourceTest, ReadsScansInOrder) {
    const auto source = openRecording(rawlogOf(mixed()));
    EXPECT_THAT(pulledFrom(*source),
                ElementsAre("0:front:1", "1:front:3", "1:rear:4", "2:rear:5", "3:front:6"));
    EXPECT_FALSE(source->nextScan());
    EXPECT_EQ(source->scansKnown(), 4u);
}

/// A cloud of this model's beams, some of which point at the sky.
mrpt::obs::CObservationPointCloud::Ptr spin(double seconds, const std::string& label,
                                            const std::string& model, int columns = 500) {
    const test::SimpleScene scene{{{{-30, -30, -9}, {30, 30, 30}}}, {}, {}, true};
    const Scan scan = test::scanScene(scene, sensorModel(model), columns, {0, 0, 2}).scan;
    return observations::observationOf(scan, label, timeAt(seconds));
}

/// "entry:label:sensor" of every scan; "-" if no beams are known.
std::vector<std::string> beamsPulledFrom(ScanSource& source) {
    std::vector<std::string> pulled;
    while (const auto scan = source.nextScan()) {
        pulled.push_back(std::to_string(scan->entry) + ":" + scan->observation->sensorLabel + ":" +
                         (scan->beams ? scan->beams->sensor.name : "-"));
    }
    return pulled;
}

TEST_F(ScanSourceTest, RecoversBeamsByLabel) {
    const auto source =
        openRecording(rawlogOf({labelledCloud(1, "front"),
                                frameOf({spin(2, "front", "VLP-16"), spin(2, "rear", "HDL-32E")}),
                                spin(3, "front", "VLP-16"), labelledCloud(4, "top"),
                                test::poleScanFrom(5, "packets"), spin(6, "late", "HDL-64E")}));
    source->useSettings({});
    EXPECT_THAT(beamsPulledFrom(*source),
                ElementsAre("0:front:VLP-16", "1:front:VLP-16", "1:rear:HDL-32E", "2:front:VLP-16",
                            "3:top:-", "4:packets:-", "5:late:HDL-64E"));
}

TEST_F(ScanSourceTest, RecoversSameBeamsForAnyRange) {
    const fs::path rawlog =
        rawlogOf({spin(1, "a", "VLP-16", 900), spin(2, "a", "HDL-32E"), spin(3, "a", "HDL-32E"),
                  spin(4, "a", "VLP-16"), spin(5, "a", "VLP-16"), spin(6, "a", "HDL-64E", 900)});
    // The fullest of the first five clouds is used; the sixth is too late.
    const auto whole = openRecording(rawlog);
    const int max_columns = whole->beamsOf("a")->max_columns;
    EXPECT_EQ(whole->beamsOf("a")->sensor.name, "HDL-32E");
    for (const std::size_t first : {0, 4, 5}) {
        SourceOptions options;
        options.first_scan = first;
        const auto part = openRecording(rawlog, options);
        part->useSettings({});
        const auto scan = part->nextScan();
        ASSERT_TRUE(scan && scan->beams);
        EXPECT_EQ(scan->beams->sensor.name, "HDL-32E");
        EXPECT_EQ(scan->beams->max_columns, max_columns);
    }
}

TEST_F(ScanSourceTest, SkipsRecoveryForNamedSensor) {
    const fs::path rawlog = rawlogOf({spin(1, "a", "VLP-16")});
    Settings settings;
    settings.sensor.model = "VLP-16";
    const auto named = openRecording(rawlog), unused = openRecording(rawlog);
    EXPECT_EQ(named->useSettings(settings).sensor.model, "VLP-16");
    EXPECT_THAT(beamsPulledFrom(*named), ElementsAre("0:a:-"));
    EXPECT_THAT(beamsPulledFrom(*unused), ElementsAre("0:a:-"));
}

TEST_F(ScanSourceTest, RecoversBeamsFromScanFolder) {
    const fs::path folder = scanFolderOf(3);
    SourceOptions options;
    options.first_scan = options.last_scan = 0;
    Scan scan;
    const auto full = spin(0, "", "HDL-32E");
    observations::readCloudPoints(*full, scan);
    writeScan(folder / "velodyne/000002.bin", scan);
    const auto source = openRecording(folder, options);
    source->useSettings({});
    EXPECT_THAT(beamsPulledFrom(*source), ElementsAre("0:velodyne:HDL-32E"));
    EXPECT_FALSE(source->beamsOf("other"));

    std::ofstream(folder / "sensor.yaml") << "sensor: {model: VLP-16}";
    const auto named = openRecording(folder);
    named->useSettings({});
    EXPECT_THAT(beamsPulledFrom(*named),
                ElementsAre("0:velodyne:-", "1:velodyne:-", "2:velodyne:-"));
}

TEST_F(ScanSourceTest, ReportsTruncationAfterRecovery) {
    const fs::path rawlog = rawlogOf({spin(1, "a", "VLP-16"), spin(2, "a", "VLP-16")});
    const std::string bytes = test::readFile(rawlog);
    std::ofstream(rawlog, std::ios::binary) << bytes.substr(0, bytes.size() - 100);
    const auto source = openRecording(rawlog);
    source->useSettings({});
    const auto scan = source->nextScan();
    ASSERT_TRUE(scan && scan->beams);
    EXPECT_EQ(scan->beams->sensor.name, "VLP-16");
    EXPECT_THROW(source->nextScan(), BrokenRecording);

    const fs::path folder = scanFolderOf(2);
    std::ofstream(folder / "velodyne/000001.bin") << "cut";
    const auto scans = openRecording(folder);
    scans->useSettings({});
    EXPECT_TRUE(scans->nextScan());
    EXPECT_THROW(scans->nextScan(), BrokenRecording);
}

TEST_F(ScanSourceTest, InterruptsRecovery) {
    int asked = 0;
    SourceOptions options;
    options.keep_going = [&] { return ++asked <= 3; };
    const auto source = openRecording(rawlogOf(Entries(20, labelledCloud(1, "a"))), options);
    source->useSettings({});
    EXPECT_THROW(source->nextScan(), Interrupted);
    EXPECT_EQ(asked, 4);
}

TEST_F(ScanSourceTest, ReturnsEveryEntry) {
    const fs::path rawlog = rawlogOf(mixed());
    const auto source = openRecording(rawlog);
    RawlogReader reader(rawlog);
    std::size_t scans = 0;
    std::vector<std::size_t> numbers;
    while (const auto expected = reader.next()) {
        const auto entry = source->nextEntry();
        ASSERT_TRUE(entry);
        numbers.push_back(entry->number);
        EXPECT_EQ(entry->object->GetRuntimeClass(), expected->GetRuntimeClass());
        EXPECT_DOUBLE_EQ(entry->fraction_read, reader.fractionRead());
        scans += entry->scans.size();
    }
    EXPECT_FALSE(source->nextEntry());
    EXPECT_EQ(scans, 5u);
    EXPECT_THAT(numbers, ElementsAre(0, 1, 1, 2, 3));  // a comment precedes the second scan
}

TEST_F(ScanSourceTest, ReadsSelectedLidarsAndScans) {
    SourceOptions options;
    options.sensor_labels = {"front"};
    options.first_scan = 1;
    options.last_scan = 2;
    const auto source = openRecording(rawlogOf(mixed()), options);
    EXPECT_THAT(pulledFrom(*source), ElementsAre("1:front:3"));
    EXPECT_THAT(source->otherLabels(), ElementsAre("rear"));
    EXPECT_EQ(source->entriesSkipped(), 1u);
    EXPECT_EQ(source->scansKnown(), 3u);
}

TEST_F(ScanSourceTest, ReadsScanFolder) {
    const auto source = openRecording(scanFolderOf(3, "1001\n1002\n1004\n"));
    EXPECT_EQ(source->scansKnown(), 3u);
    for (int i = 0; i < 3; ++i) {
        const auto entry = source->nextEntry();
        ASSERT_TRUE(entry);
        EXPECT_EQ(entry->object, nullptr);
        ASSERT_EQ(entry->scans.size(), 1u);
        const RecordedScan& scan = entry->scans[0];
        EXPECT_EQ(scan.name, "00000" + std::to_string(i));
        EXPECT_EQ(titleOf(scan), "scan " + std::to_string(i) + " (00000" + std::to_string(i) + ")");
        EXPECT_EQ(scan.observation->sensorLabel, "velodyne");
        observations::ObservedScan observed;
        observations::readObservation(*scan.observation, {}, observed);
        EXPECT_EQ(observed.scan.x_m, returnAt(static_cast<float>(i)).x_m);
        EXPECT_EQ(observed.scan.intensity, returnAt(0).intensity);
    }
    EXPECT_FALSE(source->nextEntry());
}

TEST_F(ScanSourceTest, AssumesTenScansPerSecond) {
    const auto times = openRecording(scanFolderOf(3))->scanTimes();
    ASSERT_EQ(times.size(), 1u);
    const auto& of_folder = times.at("velodyne");
    ASSERT_EQ(of_folder.size(), 3u);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(mrpt::Clock::toDouble(of_folder[static_cast<std::size_t>(i)]), 0.1 * i, 1e-6);
    }
}

TEST_F(ScanSourceTest, ConvertsFolderScansToObjects) {
    SourceOptions options;
    options.folder_objects = observations::CloudClass::Simple;
    const auto entry = openRecording(scanFolderOf(1), options)->nextEntry();
    ASSERT_TRUE(entry);
    const auto object = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(entry->object);
    ASSERT_TRUE(object);
    EXPECT_EQ(object->pointcloud->size(), 1u);
    EXPECT_EQ(object->sensorLabel, "velodyne");
}

TEST_F(ScanSourceTest, UsesLaterPosesFromRawlog) {
    const auto source =
        openRecording(rawlogOf({pose(0.9, 5, 0), labelledCloud(1, "front"), pose(1.1, 7, 0)}));
    source->usePoses({});
    EXPECT_EQ(source->poses().source, "CObservationRobotPose");
    const auto scan = source->nextScan();
    ASSERT_TRUE(scan && scan->pose.sensor_pose);
    EXPECT_NEAR(scan->pose.sensor_pose->x(), 6.0, 1e-6);
    EXPECT_NEAR(scan->pose.sensor_pose->z(), 1.25, 1e-6);  // includes the mounting height
    EXPECT_TRUE(scan->pose.pose_has_horizon);
}

TEST_F(ScanSourceTest, UsesAttitudeFromSkippedEntries) {
    SourceOptions options;
    options.first_scan = 1;
    const auto source =
        openRecording(rawlogOf({pose(0.9, 0, 0.1), pose(0.95, 0, 0.2), labelledCloud(0.96, "front"),
                                labelledCloud(1, "front"), pose(1.05, 0, 0.3)}),
                      options);
    const auto scan = source->nextScan();
    ASSERT_TRUE(scan && scan->pose.attitude);
    EXPECT_NEAR(scan->pose.attitude->pitch_rad, 0.2, 1e-6);
}

TEST_F(ScanSourceTest, PrefersAttitudeFromPoseFile) {
    writeTumPoses(folder_ / "flight.tum", {{1001.0, CPose3D(3, 0, 0, 0, 0.4, 0)}});
    const auto source = openRecording(rawlogOf({pose(0.95, 0, 0.2), labelledCloud(1, "front")}));
    source->usePoses(folder_ / "flight.tum");
    const auto scan = source->nextScan();
    ASSERT_TRUE(scan && scan->pose.attitude);
    EXPECT_NEAR(scan->pose.attitude->pitch_rad, 0.4, 1e-6);
    EXPECT_EQ(source->poses().source, (folder_ / "flight.tum").string());
}

TEST_F(ScanSourceTest, AppliesKittiFileToSelectedLidar) {
    writeKittiPoses(folder_ / "poses.txt", {CPose3D(0, 0, 0, 0, 0, 0), CPose3D(1, 0, 0, 0, 0, 0),
                                            CPose3D(2, 0, 0, 0, 0, 0)});
    SourceOptions options;
    options.sensor_labels = {"front"};
    const auto source = openRecording(rawlogOf(mixed()), options);
    source->usePoses(folder_ / "poses.txt");
    for (int i = 0; i < 3; ++i) {
        const auto scan = source->nextScan();
        ASSERT_TRUE(scan && scan->pose.sensor_pose);
        EXPECT_NEAR(scan->pose.sensor_pose->x(), i, 1e-6);
        EXPECT_FALSE(scan->pose.pose_has_horizon);
        EXPECT_FALSE(scan->pose.attitude);
    }
    EXPECT_THAT(
        test::messageOf([&] { openRecording(rawlogOf(mixed()))->usePoses(folder_ / "poses.txt"); }),
        HasSubstr("the log has 2 LiDARs"));
}

TEST_F(ScanSourceTest, KeepsAttitudeWithKittiFile) {
    writeKittiPoses(folder_ / "poses.txt", {CPose3D(0, 0, 0, 0, 0.4, 0)});
    const auto source = openRecording(rawlogOf({pose(0.95, 0, 0.2), labelledCloud(1, "front")}));
    source->usePoses(folder_ / "poses.txt");
    const auto scan = source->nextScan();
    ASSERT_TRUE(scan && scan->pose.attitude && scan->pose.sensor_pose);
    EXPECT_NEAR(scan->pose.attitude->pitch_rad, 0.2, 1e-6);
    EXPECT_FALSE(scan->pose.pose_has_horizon);
}

TEST_F(ScanSourceTest, ListsScanTimesForAllLidars) {
    SourceOptions options;
    options.sensor_labels = {"rear"};
    const auto times = openRecording(rawlogOf(mixed()), options)->scanTimes();
    ASSERT_EQ(times.size(), 2u);
    EXPECT_EQ(times.at("front").size(), 3u);
    EXPECT_THAT(times.at("rear"), ElementsAre(timeAt(4), timeAt(5)));
}

TEST_F(ScanSourceTest, ScanTimesDoNotDependOnPoses) {
    const auto source = openRecording(rawlogOf({pose(0.9, 5, 0), labelledCloud(1, "front")}));
    const auto before = source->scanTimes();
    source->usePoses({});
    EXPECT_EQ(source->scanTimes(), before);
    EXPECT_EQ(source->poses().source, "CObservationRobotPose");
}

TEST_F(ScanSourceTest, UsesSensorFromFolder) {
    const fs::path folder = scanFolderOf(1);
    std::ofstream(folder / "sensor.yaml") << "sensor:\n  model: HDL-32E\n";
    EXPECT_EQ(openRecording(folder)->settingsFor({}).sensor.model, "HDL-32E");
    EXPECT_EQ(openRecording(rawlogOf(mixed()))->settingsFor({}).sensor.model, std::nullopt);
}

TEST_F(ScanSourceTest, StopsOnRequest) {
    int asked = 0;
    SourceOptions options;
    options.keep_going = [&] { return ++asked <= 2; };
    const auto source = openRecording(rawlogOf(mixed()), options);
    EXPECT_TRUE(source->nextEntry());
    EXPECT_TRUE(source->nextEntry());
    EXPECT_THROW(source->nextEntry(), Interrupted);
}

TEST_F(ScanSourceTest, StopsLookAheadOnRequest) {
    int asked = 0;
    SourceOptions options;
    options.keep_going = [&] { return ++asked != 3; };
    const auto source = openRecording(rawlogOf(mixed()), options);
    EXPECT_THROW(source->scanTimes(), Interrupted);
    EXPECT_EQ(source->scanTimes().at("front").size(), 3u);  // no partial result is kept
}

TEST_F(ScanSourceTest, ReportsRawlogLookAheadErrors) {
    PackedInput stream(rawlogOf(mixed()));
    std::string bytes(1 << 16, '\0');
    bytes.resize(stream.Read(bytes.data(), bytes.size()));
    const fs::path rawlog = folder_ / "plain.rawlog";
    for (const std::size_t last : {1u, 3u, 100u}) {
        std::ofstream(rawlog, std::ios::binary) << bytes;
        SourceOptions options;
        options.last_scan = last;
        const auto source = openRecording(rawlog, options);  // opens the file replaced below
        fs::remove(rawlog);
        std::ofstream(rawlog, std::ios::binary) << bytes.substr(0, bytes.size() - 10);
        source->scanTimes();
        for (int i = 0; i < (last == 1 ? 3 : 5); ++i) EXPECT_TRUE(source->nextEntry());
        const std::string message = test::messageOf([&] { source->nextEntry(); });
        const bool is_needed = last > 1;
        EXPECT_THAT(message, HasSubstr(is_needed ? "(found while reading ahead)" : ""));
        EXPECT_EQ(message.empty(), !is_needed) << message;
        fs::remove(rawlog);
    }
}

TEST_F(ScanSourceTest, ReportsFolderLookAheadErrors) {
    const fs::path folder = scanFolderOf(3), file = folder / "velodyne/000001.bin";
    for (const std::size_t first : {0u, 2u}) {
        int asked = 0;
        SourceOptions options;
        options.first_scan = first;
        options.keep_going = [&] {  // called before each file; single returns never settle beams
            ++asked;
            const int shown = asked - static_cast<int>(first) - 1;
            if (shown == 2) fs::resize_file(file, 10);
            if (shown == 3) writeScan(file, returnAt(1));
            return true;
        };
        const auto source = openRecording(folder, options);
        source->useSettings({});
        for (std::size_t i = first; i < 3; ++i) EXPECT_TRUE(source->nextScan());
        const std::string message = test::messageOf([&] { source->nextScan(); });
        const bool is_needed = first == 0;  // otherwise, the broken scan is not selected
        EXPECT_THAT(message, HasSubstr(is_needed ? "000001.bin: 10 bytes" : ""));
        EXPECT_EQ(message.empty(), !is_needed) << message;
    }
}

TEST_F(ScanSourceTest, SuggestsRecordingsInFolder) {
    const std::string capture("\xd4\xc3\xb2\xa1", 4);
    folder_.write("flights/notes.txt", "two flights");
    folder_.write("flights/b.pcap", capture);
    const auto messageOf = [&] {
        return test::messageOf([&] { openRecording(folder_ / "flights"); });
    };
    EXPECT_THAT(messageOf(), HasSubstr("flights: is a folder with 1 recording; pass it: " +
                                       (folder_ / "flights/b.pcap").string()));
    folder_.write("flights/a.bag", "#ROSBAG V2.0\n");
    folder_.write("flights/c.rawlog", "");
    EXPECT_THAT(messageOf(),
                HasSubstr("flights: is a folder with 3 recordings; pass one of them: " +
                          (folder_ / "flights/a.bag").string()));
    // Clouds beside recordings are read.
    folder_.write("flights/1.bin", "");
    EXPECT_TRUE(openRecording(folder_ / "flights"));
}

TEST_F(ScanSourceTest, ReadsCloudsBesideRecording) {
    folder_.write("clouds/000000.npy", "");
    folder_.write("clouds/segmented.mcap", "\x89MCAP0\r\n");
    std::filesystem::create_directory(folder_ / "clouds/more");
    const auto source = openRecording(folder_ / "clouds");
    EXPECT_EQ(source->scansKnown(), 1u);
    EXPECT_THAT(source->remarks(),
                testing::Contains(HasSubstr("ignored 1 file without the extension")));
    EXPECT_THAT(source->remarks(), testing::Contains("ignored 1 subfolder"));
}

TEST_F(ScanSourceTest, ReportsOtherFilesInScanFolder) {
    const fs::path folder = scanFolderOf(2);
    folder_.write("scans/velodyne/000002.bin.gz", "");
    folder_.write("scans/velodyne/000003.BIN", "");
    const auto source = openRecording(folder);
    EXPECT_EQ(source->scansKnown(), 2u);
    EXPECT_THAT(source->remarks(), ElementsAre(HasSubstr("ignored 2 files in ")));
    EXPECT_THAT(source->remarks(), ElementsAre(HasSubstr("such as 000002.bin.gz")));
}

TEST_F(ScanSourceTest, SuggestsSingleLidarFolder) {
    scanFolderOf(2);
    fs::create_directories(folder_ / "both");
    fs::rename(folder_ / "scans", folder_ / "both/velodyne");
    EXPECT_THAT(test::messageOf([&] { openRecording(folder_ / "both"); }),
                HasSubstr("; there are scans in " + (folder_ / "both/velodyne").string()));
}

TEST_F(ScanSourceTest, DistinguishesSensorAndVehiclePoses) {
    const fs::path folder = scanFolderOf(1, "1001\n");
    writeTumPoses(folder / "poses.tum", {{1000.9, CPose3D()}, {1001.1, CPose3D()}});
    const auto scans = openRecording(folder);
    scans->usePoses({});
    EXPECT_TRUE(scans->nextScan()->pose.is_of_sensor);
    const fs::path log = rawlogOf({labelledCloud(1, "front")});
    const auto vehicle = openRecording(log);
    vehicle->usePoses(folder / "poses.tum");
    EXPECT_FALSE(vehicle->nextScan()->pose.is_of_sensor);
    writeKittiPoses(folder_ / "kitti.txt", {CPose3D()});
    const auto sensor = openRecording(log);
    sensor->usePoses(folder_ / "kitti.txt");
    EXPECT_TRUE(sensor->nextScan()->pose.is_of_sensor);
    // An IMU or robot pose specifies the vehicle's attitude, even if there are poses of the sensor.
    const auto both = openRecording(rawlogOf({pose(0.95, 0, 0.1), labelledCloud(1, "front")}));
    both->usePoses(folder_ / "kitti.txt");
    const auto scan = both->nextScan();
    ASSERT_TRUE(scan->pose.attitude);
    EXPECT_TRUE(scan->pose.is_of_sensor);
    EXPECT_FALSE(scan->pose.attitude_is_of_sensor);
}

TEST_F(ScanSourceTest, SuggestsDeeperFolder) {
    folder_.write("data/samples/LIDAR_TOP/1.pcd.bin", "");
    const std::string message = test::messageOf([&] { openRecording(folder_ / "data"); });
    EXPECT_THAT(message, HasSubstr("data: not a scan folder"));
    EXPECT_THAT(message,
                HasSubstr("; there are scans in " + (folder_ / "data/samples/LIDAR_TOP").string()));
}

TEST_F(ScanSourceTest, ReportsUnreadableInputs) {
    EXPECT_THAT(test::messageOf([&] { openRecording(folder_ / "none.rawlog"); }),
                HasSubstr("none.rawlog: no such file or folder"));
    fs::create_directories(folder_ / "empty");
    EXPECT_THAT(test::messageOf([&] { openRecording(folder_ / "empty"); }),
                HasSubstr("empty: not a scan folder"));
    EXPECT_THAT(test::messageOf([&] { openRecording(folder_ / "empty"); }),
                Not(HasSubstr("there are scans in")));
    EXPECT_THAT(test::messageOf([&] { openRecording(scanFolderOf(2, "1001\n")); }),
                HasSubstr("times.txt: has 1 line for 2 scans"));
}

}  // namespace
}  // namespace hagen::recordings
