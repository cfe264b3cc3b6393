#include <gmock/gmock.h>
#include <hagen/convert/Conversion.h>
#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/recordings/RawlogReader.h>
#include <hagen/recordings/ScanFolder.h>
#include <hagen/scan/Angle.h>
#include <mrpt/io/lazy_load_path.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservation3DScene.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include "convert/RawlogWriter.h"
#include "recordings/PoseFile.h"

#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "support/CaptureWriter.h"
#include "support/Program.h"
#include "support/RotatingScans.h"
#include "support/SimpleFirings.h"

namespace hagen::convert {
namespace {

using testing::AllOf;
using testing::HasSubstr;

namespace fs = std::filesystem;
using mrpt::obs::CObservation;
using mrpt::obs::CObservationPointCloud;

CObservation::Ptr scanFrom(double x_m, const std::string& label = "lidar") {
    return test::poleScanFrom(x_m, label);
}

/// An observation that is not a LiDAR scan.
CObservation::Ptr pose() {
    auto observation = mrpt::obs::CObservationRobotPose::Create();
    observation->sensorLabel = "pose";
    observation->timestamp = mrpt::Clock::fromDouble(100.0);
    return observation;
}

/// Parameter: number of threads.
class ConversionTest : public testing::TestWithParam<std::size_t> {
 protected:
    fs::path writeLog(const std::vector<mrpt::serialization::CSerializable::Ptr>& entries) {
        RawlogWriter writer(folder_ / "in.rawlog", true);
        for (const auto& entry : entries) writer.write(*entry);
        writer.commit();
        return folder_ / "in.rawlog";
    }

    /// Class or label of each entry; the contents of a sensory frame are in brackets.
    static std::vector<std::string> entriesOf(const fs::path& file) {
        std::vector<std::string> names;
        recordings::RawlogReader reader(file);
        while (const auto entry = reader.next()) {
            if (const auto observation = std::dynamic_pointer_cast<CObservation>(entry)) {
                names.push_back(observation->sensorLabel);
            } else if (const auto frame =
                           std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry)) {
                std::string name = "[";
                for (const auto& part : *frame) name += " " + part->sensorLabel;
                names.push_back(name + " ]");
            } else {
                names.push_back(entry->GetRuntimeClass()->className);
            }
        }
        return names;
    }

    static Conversion nothing() {
        Conversion conversion;
        conversion.jobs = GetParam();
        return conversion;
    }
    Conversion betweenFolders(const std::string& input, const std::string& output) const {
        Conversion conversion = nothing();
        conversion.input = folder_ / input;
        conversion.folder = folder_ / output;
        return conversion;
    }
    Conversion conversion() {
        Conversion conversion = nothing();
        conversion.input = folder_ / "in.rawlog";
        conversion.rawlog = folder_ / "out.rawlog";
        return conversion;
    }

    static ConversionListener remarksInto(std::vector<std::string>& remarks) {
        ConversionListener listener;
        listener.remark = [&](const std::string& entry, const std::string& remark) {
            remarks.push_back(entry + ": " + remark);
        };
        return listener;
    }
    static ConversionListener unreadableInto(std::string& reports) {
        ConversionListener listener;
        listener.unreadable = [&](const std::string& entry, const std::string& why) {
            reports += entry + ": " + why;
        };
        return listener;
    }

    test::TemporaryFolder folder_;
};

TEST_P(ConversionTest, AddsCloudsAfterTheirScan) {
    writeLog({pose(), scanFrom(0), pose(), scanFrom(1, ""), pose()});
    const ConversionReport report = convert(conversion());
    EXPECT_EQ(entriesOf(folder_ / "out.rawlog"),
              (std::vector<std::string>{"pose", "lidar", "lidar_roi", "lidar_non_roi", "pose", "",
                                        "_roi", "_non_roi", "pose"}));
    EXPECT_EQ(report.entries, 5u);
    EXPECT_EQ(report.scans, 2u);
    EXPECT_EQ(report.roi + report.rou + report.unclassified, report.returns);
    EXPECT_GT(report.roi, 80u);
}

TEST_P(ConversionTest, AddsCloudsToSensoryFrame) {
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(scanFrom(0, "front"));
    frame->insert(pose());
    frame->insert(scanFrom(0, "rear"));
    writeLog({mrpt::obs::CActionCollection::Create(), frame});
    EXPECT_EQ(convert(conversion()).scans, 2u);
    EXPECT_EQ(entriesOf(folder_ / "out.rawlog"),
              (std::vector<std::string>{
                  "mrpt::obs::CActionCollection",
                  "[ front pose rear front_roi front_non_roi rear_roi rear_non_roi ]"}));
}

TEST_P(ConversionTest, ReproducesOwnOutput) {
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(scanFrom(2, "rear"));
    frame->insert(pose());
    writeLog({pose(), scanFrom(0), scanFrom(1), frame});
    Conversion first = conversion();
    first.preview = true;
    convert(first);
    Conversion again = first;
    again.input = first.rawlog;
    again.rawlog = folder_ / "again.rawlog";
    const ConversionReport report = convert(again);
    EXPECT_EQ(report.scans, 3u);
    EXPECT_EQ(report.entries, 10u);
    EXPECT_EQ(report.results_replaced, 9u);
    EXPECT_EQ(entriesOf(again.rawlog), entriesOf(first.rawlog));
    EXPECT_EQ(test::readFile(again.rawlog), test::readFile(first.rawlog));
}

TEST_P(ConversionTest, KeepsResultsOfOtherScans) {
    writeLog({scanFrom(0, "front"), scanFrom(0, "rear")});  // at equal times
    Conversion first = conversion();
    first.preview = true;
    convert(first);
    Conversion again = conversion();
    again.input = folder_ / "out.rawlog";
    again.rawlog = folder_ / "again.rawlog";
    again.source.sensor_labels = {"rear"};
    EXPECT_EQ(convert(again).results_replaced, 3u);
    EXPECT_EQ(entriesOf(again.rawlog),
              (std::vector<std::string>{"front", "front_roi", "front_non_roi", "", "rear",
                                        "rear_roi", "rear_non_roi"}));
    Conversion cut = conversion();
    cut.input = folder_ / "out.rawlog";
    cut.rawlog = folder_ / "cut.rawlog";
    cut.source.first_scan = 1;
    EXPECT_EQ(convert(cut).results_replaced, 3u);
    EXPECT_EQ(entriesOf(cut.rawlog),
              (std::vector<std::string>{"front_roi", "front_non_roi", "", "rear", "rear_roi",
                                        "rear_non_roi"}));
}

TEST_P(ConversionTest, SegmentsScanLabelledAsResult) {
    auto observed = std::make_unique<observations::ObservedScan>();
    observations::readObservation(*scanFrom(0), {}, *observed);
    writeLog({observations::observationOf(observed->scan, "front_roi", {})});
    EXPECT_EQ(convert(conversion()).scans, 1u);
    EXPECT_EQ(entriesOf(folder_ / "out.rawlog"),
              (std::vector<std::string>{"front_roi", "front_roi_roi", "front_roi_non_roi"}));
}

TEST_P(ConversionTest, WritesEqualLabelsToFolder) {
    writeLog({scanFrom(0), scanFrom(1)});
    Conversion both = conversion();
    both.folder = folder_ / "scans";
    const ConversionReport report = convert(both);
    const recordings::ScanFolder scans(both.folder);
    ASSERT_EQ(scans.size(), 2u);
    EXPECT_NEAR(scans.times()[1], mrpt::Clock::toDouble(scanFrom(1)->timestamp), 1e-6);
    std::size_t roi = 0, returns = 0;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const auto labels = recordings::readLabels(scans.labelFile(i));
        roi += std::count(labels.begin(), labels.end(), 2);
        returns += labels.size();
    }
    EXPECT_EQ(roi, report.roi);
    EXPECT_EQ(returns, report.returns);
}

TEST_P(ConversionTest, ConvertsScanFolder) {
    writeLog({scanFrom(0)});
    convert(betweenFolders("in.rawlog", "scans"));
    fs::rename(folder_ / "scans/velodyne/000000.bin", folder_ / "scans/velodyne/000042.bin");

    Conversion from_folder = betweenFolders("scans", "labels");
    from_folder.rawlog = folder_ / "from_folder.rawlog";
    const ConversionReport report = convert(from_folder);
    EXPECT_EQ(report.scans, 1u);
    EXPECT_EQ(entriesOf(from_folder.rawlog),
              (std::vector<std::string>{"velodyne", "velodyne_roi", "velodyne_non_roi"}));
    EXPECT_EQ(recordings::readLabels(folder_ / "labels/labels/000042.label").size(),
              report.returns);
    EXPECT_EQ(test::readFile(folder_ / "labels/velodyne/000042.bin"),
              test::readFile(folder_ / "scans/velodyne/000042.bin"));
}

TEST_P(ConversionTest, PrefersBeamsFromRecording) {
    fs::create_directories(folder_ / "scans/velodyne");
    recordings::writeScan(folder_ / "scans/velodyne/000000.bin",
                          test::scanScene({}, sensorModel("HDL-32E"), 100, {0, 0, 2}).scan);
    folder_.write("scans/sensor.yaml", "sensor: {model: HDL-32E}");
    Conversion from_folder = betweenFolders("scans", "labels");
    from_folder.settings.sensor.model = "HDL-64E";
    convert(from_folder);
    Settings written;
    mergeSettings(folder_ / "labels/sensor.yaml", written);
    EXPECT_EQ(written.sensorModel().rows(), 32);
}

/// The scans of these observations as clouds that do not name their sensor.
std::vector<mrpt::serialization::CSerializable::Ptr> cloudsOf(
    const std::vector<CObservation::Ptr>& scans) {
    std::vector<mrpt::serialization::CSerializable::Ptr> clouds;
    observations::ObservedScan observed;
    for (const auto& scan : scans) {
        observations::readObservation(*scan, {}, observed);
        clouds.push_back(
            observations::observationOf(observed.scan, scan->sensorLabel, scan->timestamp));
    }
    return clouds;
}

TEST_P(ConversionTest, LabelsCloudsLikeTheirPackets) {
    const std::vector<CObservation::Ptr> scans{scanFrom(0), scanFrom(1), scanFrom(2), scanFrom(3)};
    writeLog({scans.begin(), scans.end()});
    Conversion of_packets = conversion();
    of_packets.folder = folder_ / "of_packets";
    mergeSettings(HAGEN_SOURCE_DIR "/config/vlp16.yaml", of_packets.settings);
    convert(of_packets);
    writeLog(cloudsOf(scans));
    Conversion of_clouds = conversion();
    of_clouds.rawlog = folder_ / "of_clouds.rawlog";
    of_clouds.folder = folder_ / "of_clouds";
    const ConversionReport report = convert(of_clouds);
    EXPECT_EQ(report.recovered.at("lidar").beams->sensor.name, "VLP-16");
    EXPECT_EQ(report.recovered.at("lidar").columns, 870);
    EXPECT_THAT(report.sensors.at("lidar"), HasSubstr("beams recovered (VLP-16, which has 16)"));
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const auto expected =
            recordings::readLabels(recordings::ScanFolder(of_packets.folder).labelFile(i));
        const auto found =
            recordings::readLabels(recordings::ScanFolder(of_clouds.folder).labelFile(i));
        ASSERT_EQ(found.size(), expected.size());
        std::size_t same = 0;
        for (std::size_t k = 0; k < found.size(); ++k) same += found[k] == expected[k];
        EXPECT_GE(static_cast<double>(same), 0.99 * static_cast<double>(found.size())) << i;
    }
}

TEST(Conversion, CloudLabelsDoNotDependOnThreads) {
    const test::TemporaryFolder folder;
    std::vector<CObservation::Ptr> scans;
    for (int i = 0; i < 12; ++i) scans.push_back(scanFrom(0.3 * i, i % 3 == 0 ? "rear" : "front"));
    auto clouds = cloudsOf(scans);
    // The first cloud of each label has only three beams, too few to recover a model.
    for (const std::size_t first : {0, 1}) {
        auto& points = *dynamic_cast<CObservationPointCloud&>(*clouds[first]).pointcloud;
        std::vector<bool> is_deleted;
        for (std::size_t i = 0; i < points.size(); ++i) {
            float x = 0, y = 0, z = 0;
            points.getPoint(i, x, y, z);
            is_deleted.push_back(z > -0.18f * std::hypot(x, y));
        }
        observations::deletePoints(is_deleted, points);
    }
    RawlogWriter writer(folder / "in.rawlog", true);
    for (const auto& entry : clouds) writer.write(*entry);
    writer.commit();
    int window_scans = 1;
    const auto converted = [&](std::size_t jobs, std::size_t from, std::size_t to) {
        Conversion conversion;
        conversion.settings.options.window_scans = window_scans;
        conversion.input = folder / "in.rawlog";
        conversion.rawlog = folder / "out.rawlog";
        conversion.overwrite = true;
        conversion.jobs = jobs;
        conversion.source.first_scan = from;
        conversion.source.last_scan = to;
        const ConversionReport report = convert(conversion);
        for (const auto& [label, recovered] : report.recovered) {
            EXPECT_EQ(recovered.beams->sensor.name, "VLP-16") << label;
        }
        return std::pair(test::readFile(conversion.rawlog), report.scan_reports);
    };
    const auto alone = converted(1, 0, 11);
    EXPECT_EQ(converted(4, 0, 11).first, alone.first);
    // Labels do not depend on the converted range either.
    EXPECT_EQ(converted(2, 0, 0).second.front().roi, alone.second.front().roi);
    EXPECT_EQ(converted(2, 6, 11).second.back().roi, alone.second.back().roi);
    window_scans = 3;  // in order, whatever the number of threads
    EXPECT_EQ(converted(4, 0, 11).first, converted(1, 0, 11).first);
}

TEST_P(ConversionTest, KeepsPosesFromScanFolder) {
    fs::create_directories(folder_ / "scans/velodyne");
    const Scan scan = test::scanScene({}, sensorModel("VLP-16"), 870, {0, 0, 2}).scan;
    recordings::writeScan(folder_ / "scans/velodyne/000000.bin", scan);
    recordings::writeScan(folder_ / "scans/velodyne/000001.bin", scan);
    folder_.write("scans/poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 -5 0 0 1 0\n");
    EXPECT_EQ(convert(betweenFolders("scans", "labels")).scans_with_pose, 2u);
    const auto poses = recordings::readKittiPoses(folder_ / "labels/poses.txt");
    ASSERT_EQ(poses.size(), 2u);
    EXPECT_NEAR(poses[0].norm(), 0.0, 1e-9);
    EXPECT_NEAR((poses[1] - mrpt::poses::CPose3D(0, -5, 0, 0, 0, 0)).norm(), 0.0, 1e-9);
}

TEST_P(ConversionTest, KeepsPosesFromLog) {
    const auto poseAt = [](double x_m) {
        auto observation = mrpt::obs::CObservationRobotPose::Create();
        observation->sensorLabel = "pose";
        observation->timestamp = mrpt::Clock::fromDouble(100.0 + x_m);
        observation->pose.mean = mrpt::poses::CPose3D(x_m, 0, 2, 0, 0, 0);
        return observation;
    };
    // The second scan lies between two poses; the later one follows the scan in the log.
    writeLog({poseAt(0), scanFrom(0), poseAt(0.05), scanFrom(0.1), poseAt(0.15), poseAt(0.25),
              scanFrom(3), scanFrom(4)});
    Conversion posed = conversion();
    posed.folder = folder_ / "scans";
    std::vector<std::string> remarks;
    const ConversionListener listener = remarksInto(remarks);
    EXPECT_EQ(convert(posed, listener).scans_with_pose, 2u);
    const auto poses = recordings::readTumPoses(folder_ / "scans/poses.tum");
    ASSERT_EQ(poses.size(), 2u);
    EXPECT_NEAR(poses[1].pose.x(), 0.1, 1e-6);
    // One remark per scan without a nearby pose.
    ASSERT_EQ(remarks.size(), 2u);
    EXPECT_EQ(remarks[0].rfind("scan 2 (lidar): ", 0), 0u) << remarks[0];
    EXPECT_EQ(remarks[1].rfind("scan 3 (lidar): no pose", 0), 0u) << remarks[1];
}

TEST_P(ConversionTest, ReportsScanWithoutTime) {
    const auto timeless = scanFrom(0);
    timeless->timestamp = INVALID_TIMESTAMP;
    writeLog({timeless, scanFrom(1)});
    std::vector<std::string> remarks;
    convert(betweenFolders("in.rawlog", "scans"), remarksInto(remarks));
    EXPECT_THAT(remarks, testing::ElementsAre("scan 0 (lidar): no valid time"));
    Conversion back = nothing();
    back.input = folder_ / "scans";
    back.rawlog = folder_ / "back.rawlog";
    convert(back);
    recordings::RawlogReader reader(back.rawlog);
    const auto first = std::dynamic_pointer_cast<CObservation>(reader.next());
    ASSERT_TRUE(first);
    EXPECT_EQ(first->timestamp, INVALID_TIMESTAMP);
}

TEST_P(ConversionTest, ReportsMissingPosesWithoutHorizon) {
    const auto odometryAt = [](double x_m) {
        auto observation = mrpt::obs::CObservationOdometry::Create();
        observation->sensorLabel = "odometry";
        observation->timestamp = mrpt::Clock::fromDouble(100.0 + x_m);
        observation->odometry = mrpt::poses::CPose2D(x_m, 0, 0);
        return observation;
    };
    writeLog({odometryAt(0), scanFrom(0.05), odometryAt(0.1), scanFrom(3)});
    Conversion posed = conversion();
    posed.folder = folder_ / "scans";
    std::vector<std::string> remarks;
    convert(posed, remarksInto(remarks));
    EXPECT_THAT(remarks, testing::Contains(HasSubstr("(lidar): no pose near this time: no pose "
                                                     "file is written")));
    EXPECT_FALSE(fs::exists(folder_ / "scans/poses.tum"));
    EXPECT_FALSE(fs::exists(folder_ / "scans/poses.txt"));
}

/// A mount in the log and a mount in the settings lead to equal poses and results.
TEST_P(ConversionTest, AppliesMountFromSettings) {
    const mrpt::poses::CPose3D mount(0, 0, 0, 0, radians(-20), radians(180));
    const auto converted = [&](bool is_recorded, const std::string& name) {
        std::vector<mrpt::serialization::CSerializable::Ptr> entries;
        for (const double x_m : {0.0, 0.2}) {
            auto pose = mrpt::obs::CObservationRobotPose::Create();
            pose->sensorLabel = "pose";
            pose->timestamp = mrpt::Clock::fromDouble(100.0 + x_m);
            pose->pose.mean = mrpt::poses::CPose3D(x_m, 0, 2, 0.5, 0.02, -0.03);
            entries.push_back(pose);
        }
        const auto scan = scanFrom(0);
        if (is_recorded) scan->setSensorPose(mount);
        entries.push_back(scan);
        writeLog(entries);
        Conversion posed = betweenFolders("in.rawlog", name);
        posed.octomaps = {folder_ / (name + ".bt")};
        if (!is_recorded)
            posed.settings.mount = {static_cast<float>(radians(180)),
                                    static_cast<float>(radians(-20))};
        convert(posed);
        const auto poses = recordings::readTumPoses(folder_ / name / "poses.tum");
        EXPECT_EQ(poses.size(), 1u);
        return poses.at(0).pose;
    };
    const auto recorded = converted(true, "recorded"), set = converted(false, "set");
    EXPECT_LT((recorded.asVectorVal() - set.asVectorVal()).norm(), 1e-5);
    EXPECT_EQ(test::readFile(folder_ / "recorded.bt"), test::readFile(folder_ / "set.bt"));
    // When read again, the poses include the mount of sensor.yaml.
    convert(betweenFolders("set", "again"));
    EXPECT_EQ(test::readFile(folder_ / "again/labels/000000.label"),
              test::readFile(folder_ / "set/labels/000000.label"));
}

TEST_P(ConversionTest, SegmentsRangeImages) {
    const auto packets = test::poleScanFrom(0, "lidar");
    Scan scan;
    observations::decodePackets(*packets, scan);
    const auto with_points = test::rotatingImageOf(*packets, scan, {true, false});
    const auto with_ranges = test::rotatingImageOf(*packets, scan, {});
    mrpt::obs::CObservationRotatingScan unknown;
    unknown.sensorLabel = "unknown";
    unknown.rowCount = 5;
    unknown.columnCount = 8;
    unknown.rangeResolution = 0.01;
    unknown.rangeImage.setZero(5, 8);
    mrpt::obs::CObservation3DRangeScan camera;
    camera.sensorLabel = "camera";
    camera.hasPoints3D = true;
    camera.points3D_x.assign(500, 2.0f);
    camera.points3D_y.assign(500, 0.0f);
    camera.points3D_idxs_x.assign(500, 0);
    camera.points3D_idxs_y.assign(500, 0);
    for (int i = 0; i < 500; ++i) camera.points3D_z.push_back(0.001f * static_cast<float>(i));
    test::writeBytes(folder_ / "in.rawlog", with_points.bytes + with_ranges.bytes +
                                                test::bytesOf(unknown) + test::bytesOf(camera));
    std::string remarks;
    const ConversionReport report = convert(conversion(), unreadableInto(remarks));
    EXPECT_EQ(report.scans, 3u);
    EXPECT_EQ(report.unreadable_scans, 1u);
    EXPECT_EQ(report.returns, 2 * scan.size() + 500);
    EXPECT_EQ(remarks.rfind("scan 2 (unknown): the 5 rows have no elevations", 0), 0u) << remarks;
    EXPECT_EQ(entriesOf(folder_ / "out.rawlog"),
              (std::vector<std::string>{"lidar", "lidar_roi", "lidar_non_roi", "lidar", "lidar_roi",
                                        "lidar_non_roi", "unknown", "camera", "camera_roi",
                                        "camera_non_roi"}));
}

TEST_P(ConversionTest, RejectsExternalRotatingScan) {
    mrpt::obs::CObservationRotatingScan scan;
    scan.rowCount = 3;
    scan.columnCount = 4;
    scan.rangeResolution = 0.01;
    scan.rangeImage.setZero(3, 4);
    std::string bytes = test::olderBytesOf(scan);
    bytes.resize(bytes.size() - 1 - (4 + 2 * 12 + 4 + 2));  // remove the images at the end
    bytes += '\1' + test::little32(8) + "scan.bin" + '\x88';
    test::writeBytes(folder_ / "in.rawlog", test::bytesOf(*pose()) + bytes);
    const std::string why = test::messageOf([&] { convert(conversion()); });
    EXPECT_THAT(why, HasSubstr("in.rawlog: entry 1 at byte"));
    EXPECT_THAT(why, HasSubstr("'scan.bin'; include it with 'rawlog-edit --de-externalize'"));
}

TEST_P(ConversionTest, ReportsUnreadableScan) {
    auto broken = scanFrom(0);
    std::dynamic_pointer_cast<mrpt::obs::CObservationVelodyneScan>(broken)
        ->scan_packets[0]
        .velodyne_model_ID = 0x99;
    writeLog({pose(), broken, scanFrom(1)});
    std::string remarks;
    const ConversionReport report = convert(conversion(), unreadableInto(remarks));
    EXPECT_EQ(report.unreadable_scans, 1u);
    EXPECT_EQ(report.scans, 1u);
    EXPECT_THAT(remarks, HasSubstr("scan 0 (lidar)"));
    EXPECT_THAT(remarks, HasSubstr("0x99"));
    EXPECT_EQ(entriesOf(folder_ / "out.rawlog"),
              (std::vector<std::string>{"pose", "lidar", "lidar", "lidar_roi", "lidar_non_roi"}));
}

/// The limits come from the recording; invalid limits in the settings would end the conversion.
TEST_P(ConversionTest, ReportsScanWithInvalidLimits) {
    const double nan = std::nan("");
    for (const auto& [min_m, max_m] : {std::pair{2.0, 1.0}, {nan, 100.0}, {0.0, nan}}) {
        auto broken = scanFrom(0);
        auto& scan = dynamic_cast<mrpt::obs::CObservationVelodyneScan&>(*broken);
        scan.minRange = min_m;
        scan.maxRange = max_m;
        writeLog({scanFrom(1), broken, scanFrom(2)});
        std::string remarks;
        Conversion again = conversion();
        again.overwrite = true;
        const ConversionReport report = convert(again, unreadableInto(remarks));
        EXPECT_EQ(report.unreadable_scans, 1u);
        EXPECT_EQ(report.scans, 2u);
        EXPECT_THAT(remarks, HasSubstr("scan 1 (lidar): invalid range limits"));
    }
}

TEST_P(ConversionTest, KeepsPartialOutputFromBrokenLog) {
    writeLog({scanFrom(0), scanFrom(1), scanFrom(2)});
    const std::string bytes = test::readFile(folder_ / "in.rawlog");
    folder_.write("in.rawlog", bytes.substr(0, bytes.size() / 2));
    EXPECT_THAT(test::messageOf<recordings::BrokenRecording>([&] { convert(conversion()); }),
                AllOf(HasSubstr("entry 1"), HasSubstr("out.partial.rawlog")));
    EXPECT_FALSE(fs::exists(folder_ / "out.rawlog"));
    EXPECT_EQ(entriesOf(folder_ / "out.partial.rawlog"),
              (std::vector<std::string>{"lidar", "lidar_roi", "lidar_non_roi"}));
}

TEST_P(ConversionTest, KeepsPartialOutputFromBrokenFolder) {
    writeLog({scanFrom(0), scanFrom(1)});
    convert(betweenFolders("in.rawlog", "scans.v1"));
    folder_.write("scans.v1/velodyne/000001.bin", "cut");
    EXPECT_THAT(test::messageOf([&] { convert(betweenFolders("scans.v1", "labels.v1")); }),
                AllOf(HasSubstr("000001.bin"), HasSubstr("labels.v1.partial")));
    EXPECT_EQ(recordings::ScanFolder(folder_ / "labels.v1.partial").size(), 1u);
}

TEST_P(ConversionTest, ShortensLongLabels) {
    const std::string label(300, 'a');
    writeLog({scanFrom(0, label + "b"), scanFrom(0, label + "c"), scanFrom(0, label + "d")});
    Conversion all = conversion();
    all.folder = folder_ / "scans";
    EXPECT_EQ(convert(all).scans, 3u);
    std::size_t folders = 0;
    for (const auto& entry : fs::directory_iterator(all.folder)) {
        EXPECT_EQ(recordings::ScanFolder(entry.path()).size(), 1u);
        ++folders;
    }
    EXPECT_EQ(folders, 3u);
}

TEST_P(ConversionTest, WritesScanFolderPerLidar) {
    writeLog({scanFrom(0, "front"), scanFrom(0, "rear"), scanFrom(1, "front"), scanFrom(1, "a/b")});
    Conversion all = conversion();
    all.folder = folder_ / "scans";
    convert(all);
    EXPECT_EQ(recordings::ScanFolder(folder_ / "scans/front").size(), 2u);
    EXPECT_EQ(recordings::ScanFolder(folder_ / "scans/rear").size(), 1u);
    EXPECT_EQ(recordings::ScanFolder(folder_ / "scans/a_b").size(), 1u);
    all.overwrite = true;
    all.source.sensor_labels = {"rear"};
    const ConversionReport report = convert(all);
    EXPECT_EQ(report.entries, 4u);
    EXPECT_EQ(report.scans, 1u);
    EXPECT_EQ(recordings::ScanFolder(folder_ / "scans").size(), 1u);
    EXPECT_EQ(
        entriesOf(folder_ / "out.rawlog"),
        (std::vector<std::string>{"front", "rear", "rear_roi", "rear_non_roi", "front", "a/b"}));
}

TEST_P(ConversionTest, ReportsLogWithoutScans) {
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(pose());
    frame->insert(mrpt::obs::CObservationIMU::Create());
    auto row = mrpt::obs::CObservationRotatingScan::Create();
    row->rowCount = 1;
    frame->insert(row);
    writeLog({pose(), mrpt::obs::CActionCollection::Create(), frame, pose()});
    std::vector<std::string> remarks;
    convert(conversion(), remarksInto(remarks));
    EXPECT_THAT(remarks, testing::ElementsAre(
                             "the recording: no converted entry has a LiDAR scan "
                             "(CObservationVelodyneScan, CObservationRotatingScan, "
                             "CObservationPointCloud, CObservation3DRangeScan); they have "
                             "1 CActionCollection, 1 CObservationIMU, 3 CObservationRobotPose, "
                             "1 CObservationRotatingScan of a single row"));
    remarks.clear();
    writeLog({pose(), scanFrom(0)});
    Conversion whole = conversion();
    whole.overwrite = true;
    convert(whole, remarksInto(remarks));
    EXPECT_THAT(remarks, testing::Each(testing::Not(HasSubstr("no converted entry"))));
}

TEST_P(ConversionTest, ReportsScanBeforeFirstAttitude) {
    const auto first = scanFrom(0), second = scanFrom(1);
    auto attitude = mrpt::obs::CObservationRobotPose::Create();
    attitude->timestamp = second->timestamp;
    writeLog({first, attitude, second});
    const ConversionReport report = convert(conversion());
    EXPECT_EQ(report.scans_with_attitude, 1u);
    EXPECT_EQ(report.first_without_attitude, "scan 0 (lidar)");
    EXPECT_FALSE(report.is_attitude_of_poses);
    writeLog({attitude, second});
    Conversion again = conversion();
    again.overwrite = true;
    EXPECT_EQ(convert(again).first_without_attitude, "");
}

TEST_P(ConversionTest, IncludesFirstAndLastScan) {
    writeLog({pose(), scanFrom(0), pose(), scanFrom(1), pose()});
    Conversion part = conversion();
    part.source.first_scan = part.source.last_scan = 1;
    const ConversionReport report = convert(part);
    EXPECT_EQ(report.entries, 2u);
    EXPECT_EQ(report.left_out_before, 2u);
    EXPECT_EQ(report.scan_reports.at(0).entry, 1u);
    EXPECT_EQ(entriesOf(folder_ / "out.rawlog"),
              (std::vector<std::string>{"pose", "lidar", "lidar_roi", "lidar_non_roi"}));
    part.overwrite = true;
    part.source.first_scan = part.source.last_scan = 2;
    EXPECT_THAT(test::messageOf([&] { convert(part); }),
                HasSubstr("has 2 scans, none at or after 2"));
}

TEST_P(ConversionTest, KeepsPartialOutputOnInterrupt) {
    writeLog({pose(), scanFrom(0), pose()});
    int asked = 0;
    ConversionListener listener;
    listener.keep_going = [&] { return ++asked <= 2; };
    EXPECT_THAT(test::messageOf<recordings::Interrupted>([&] { convert(conversion(), listener); }),
                HasSubstr("the 2 preceding entries are in"));
    EXPECT_FALSE(fs::exists(folder_ / "out.rawlog"));
    EXPECT_EQ(entriesOf(folder_ / "out.partial.rawlog").size(), 4u);
}

TEST_P(ConversionTest, KeepsTimesFromScanFolder) {
    writeLog({scanFrom(0)});
    convert(betweenFolders("in.rawlog", "scans"));
    folder_.write("scans/times.txt", "7.25\n");
    Conversion from_folder = nothing();
    from_folder.input = folder_ / "scans";
    from_folder.rawlog = folder_ / "timed.rawlog";
    convert(from_folder);
    recordings::RawlogReader reader(from_folder.rawlog);
    while (const auto entry = reader.next()) {
        const auto observation = std::dynamic_pointer_cast<CObservation>(entry);
        EXPECT_NEAR(mrpt::Clock::toDouble(observation->timestamp), 7.25, 1e-6);
    }
}

TEST_P(ConversionTest, FindsExternalClouds) {
    Scan scan;
    scan.x_m = {5, 6};
    scan.y_m = scan.z_m = {0, 1};
    scan.intensity = {0, 1};
    const auto cloud = observations::observationOf(scan, "lidar", mrpt::Clock::fromDouble(1.0));
    fs::create_directory(folder_ / "in_Images");
    mrpt::io::setLazyLoadPathBase((folder_ / "in_Images").string() + "/");
    cloud->setAsExternalStorage("cloud.bin",
                                CObservationPointCloud::ExternalStorageFormat::MRPT_Serialization);
    cloud->unload();  // writes the file
    writeLog({cloud});
    mrpt::io::setLazyLoadPathBase("/nowhere/");
    std::vector<std::string> remarks;
    const ConversionReport report = convert(conversion(), remarksInto(remarks));
    EXPECT_EQ(report.returns, 2u);
    ASSERT_EQ(remarks.size(), 1u);
    EXPECT_THAT(remarks[0], HasSubstr((folder_ / "out_Images").string()));
}

TEST_P(ConversionTest, StopsAtUnsuitableSettings) {
    // For a cloud, the settings name the sensor; packets have 16 beams, too few for this window.
    Scan scan;
    scan.x_m = {5, 6};
    scan.y_m = scan.z_m = {0, 1};
    scan.intensity = {0, 1};
    std::vector<mrpt::serialization::CSerializable::Ptr> entries_of_log{
        pose(), observations::observationOf(scan, "cloud", mrpt::Clock::fromDouble(1.0)),
        scanFrom(0)};
    entries_of_log.insert(entries_of_log.end(), 2000, pose());
    writeLog(entries_of_log);
    Conversion unfit = conversion();
    unfit.settings.sensor.model = "HDL-64E";
    unfit.settings.options.window_size = 20;
    std::size_t entries = 0;
    std::atomic<std::size_t> read{0};
    ConversionListener listener;
    listener.keep_going = [&] {
        ++read;
        return true;
    };
    listener.progress = [&](const ConversionReport& report) { entries = report.entries; };
    EXPECT_THROW(convert(unfit, listener), SettingsError);
    EXPECT_EQ(entries, 2u);
    EXPECT_LT(read, 1000u);  // the rest is not read
    EXPECT_FALSE(fs::exists(folder_ / "out.rawlog"));
    EXPECT_FALSE(fs::exists(folder_ / "out.partial.rawlog"));
}

TEST_P(ConversionTest, ReportsFirstError) {
    writeLog({pose(), scanFrom(0), scanFrom(1), scanFrom(2)});
    const std::string bytes = test::readFile(folder_ / "in.rawlog");
    folder_.write("in.rawlog", bytes.substr(0, bytes.size() - 10));
    Conversion unfit = conversion();
    unfit.settings.options.window_size = 20;
    EXPECT_THROW(convert(unfit), SettingsError);
}

TEST_P(ConversionTest, CompressesSmallEntries) {
    writeLog(std::vector<mrpt::serialization::CSerializable::Ptr>(2000, pose()));
    convert(conversion());
    EXPECT_EQ(entriesOf(folder_ / "out.rawlog").size(), 2000u);
    EXPECT_EQ(test::readFile(folder_ / "out.rawlog"), test::readFile(folder_ / "in.rawlog"));
    EXPECT_LT(fs::file_size(folder_ / "out.rawlog"), 50000u);
}

TEST_P(ConversionTest, ReportsProgressPerEntry) {
    writeLog({pose(), scanFrom(0), pose()});
    std::vector<std::size_t> counts;
    ConversionListener listener;
    listener.progress = [&](const ConversionReport& report) { counts.push_back(report.entries); };
    convert(conversion(), listener);
    EXPECT_EQ(counts, (std::vector<std::size_t>{1, 2, 3}));
}

INSTANTIATE_TEST_SUITE_P(Threads, ConversionTest, testing::Values(1, 4));

}  // namespace
}  // namespace hagen::convert
