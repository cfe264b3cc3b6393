// Runs the built program, as a user would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/convert/RawlogWriter.h>
#include <hagen/filter/OptionKeys.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/PoseFile.h>
#include <hagen/recordings/RawlogReader.h>
#include <hagen/recordings/ScanFolder.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CRawlog.h>
#include <unistd.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include <set>

#include "support/PolesAndWall.h"
#include "support/ProgramTest.h"
#include "support/Random.h"

namespace hagen {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;
const fs::path kRecording = fs::path(HAGEN_SOURCE_DIR) / "rawlogs/poles_and_wall.rawlog";
const std::string kConfig = HAGEN_SOURCE_DIR "/config/";
const std::string kPaper = kConfig + "paper.yaml";

class RawlogSegment : public test::ProgramTest {
 protected:
    test::Outcome run(const std::vector<std::string>& arguments) const override {
        return test::run(HAGEN_RAWLOG_SEGMENT, arguments);
    }
    nlohmann::json statistics(const std::string& file) const {
        return nlohmann::json::parse(test::readFile(path(file)));
    }
};

TEST_F(RawlogSegment, SegmentsTheRecordingThatComesWithTheProject) {
    const auto outcome = run({"-i", kRecording, "-o", path("out.rawlog")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("10 LiDAR scans in 21 entries"));
    EXPECT_THAT(outcome.out, HasSubstr(path("out.rawlog")));
    EXPECT_EQ(outcome.err, "");

    mrpt::obs::CRawlog rawlog;
    ASSERT_TRUE(rawlog.loadFromRawLogFile(path("out.rawlog")));
    ASSERT_EQ(rawlog.size(), 41u);
    for (std::size_t i = 0; i < 40; i += 4) {
        EXPECT_EQ(rawlog.getAsObservation(i)->sensorLabel, "pose");
        EXPECT_EQ(rawlog.getAsObservation(i + 1)->sensorLabel, "lidar");
        EXPECT_EQ(rawlog.getAsObservation(i + 2)->sensorLabel, "lidar_roi");
        EXPECT_EQ(rawlog.getAsObservation(i + 3)->sensorLabel, "lidar_non_roi");
        const auto roi = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(
            rawlog.getAsObservation(i + 2));
        ASSERT_NE(roi, nullptr);
        EXPECT_GT(roi->pointcloud->size(), 1000u);
        EXPECT_EQ(roi->timestamp, rawlog.getAsObservation(i + 1)->timestamp);
    }
}

TEST_F(RawlogSegment, EveryReturnOfTheRealScanIsThereOnce) {
    if (test::realScan().empty()) GTEST_SKIP() << "mrpt-common is not installed";
    ASSERT_EQ(
        run({"-i", test::realScan(), "-o", path("out.rawlog"), "--kitti", path("scans")}).exit_code,
        0);
    recordings::RawlogReader reader(path("out.rawlog"));
    ASSERT_NE(reader.next(), nullptr);
    std::size_t points = 0;
    for (const char* suffix : {"_roi", "_non_roi"}) {
        const auto cloud =
            std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(reader.next());
        ASSERT_NE(cloud, nullptr);
        EXPECT_EQ(cloud->sensorLabel, std::string("Velodyne1_SCAN") + suffix);
        points += cloud->pointcloud->size();
    }
    EXPECT_EQ(points, 22591u);
    EXPECT_EQ(reader.next(), nullptr);
    const recordings::ScanFolder scans(path("scans"));
    EXPECT_EQ(fs::file_size(scans.scanFile(0)), 22591u * 16);
    EXPECT_EQ(fs::file_size(scans.labelFile(0)), 22591u * 4);
}

TEST_F(RawlogSegment, TheSameInputGivesTheSameBytesWithAnyNumberOfThreads) {
    for (const auto& [name, jobs] : {std::pair<std::string, std::string>{"a", "1"}, {"b", "3"}}) {
        ASSERT_EQ(run({"-i", kRecording, "-o", path(name), "--kitti", path(name + "_scans"),
                       "--preview", "--jobs", jobs})
                      .exit_code,
                  0);
    }
    EXPECT_EQ(test::readFile(path("a")), test::readFile(path("b")));
    EXPECT_EQ(test::readFile(path("a_scans/labels/000009.label")),
              test::readFile(path("b_scans/labels/000009.label")));
}

TEST_F(RawlogSegment, AScanFolderGivesLabelsUnderItsOwnNames) {
    ASSERT_EQ(run({"-i", kRecording, "--kitti", path("scans")}).exit_code, 0);
    const auto outcome = run({"-i", path("scans"), "--kitti", path("again"), "-c", kPaper});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const recordings::ScanFolder scans(path("again"));
    ASSERT_EQ(scans.size(), 10u);
    EXPECT_EQ(fs::file_size(scans.labelFile(3)) * 4, fs::file_size(scans.scanFile(3)));
}

TEST_F(RawlogSegment, LaterSettingsOverrideEarlierOnes) {
    const auto narrow = folder_.write("narrow.yaml", "zone_m: 0.1\n");
    const auto outcome = run({"-i", kRecording, "-o", path("out"), "-c", kPaper, "-c", narrow});
    ASSERT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.out, HasSubstr("  0    0.0 %  region of interest"));
}

TEST_F(RawlogSegment, SaysWhichSensorItTookAndHowItKnows) {
    EXPECT_THAT(run({"-i", kRecording, "--kitti", path("scans"), "--stats", path("a.json")}).out,
                HasSubstr("sensor lidar: VLP-16, 16 beams\n"));
    EXPECT_EQ(statistics("a.json")["recovered_sensors"], nlohmann::json::object());

    fs::remove(path("scans/sensor.yaml"));
    const auto named = run({"-i", path("scans"), "--kitti", path("again"), "--stats",
                            path("b.json"), "-c", kConfig + "vlp16.yaml"});
    EXPECT_THAT(
        named.out,
        HasSubstr("sensor velodyne: VLP-16, 16 beams, 100.0 % of the returns lie on them\n"));
    const auto outcome = run(
        {"-i", path("scans"), "--kitti", path("again"), "--stats", path("b.json"), "--overwrite"});
    EXPECT_THAT(outcome.out, HasSubstr("sensor velodyne: 16 beams recovered (VLP-16), "));
    EXPECT_THAT(outcome.out, HasSubstr(" % of the returns lie on them\n"));
    const auto sensor = statistics("b.json")["recovered_sensors"]["velodyne"];
    EXPECT_EQ(sensor["name"], "VLP-16");
    EXPECT_EQ(sensor["beams"], 16);
    EXPECT_EQ(sensor["beams_seen"], 16);
    EXPECT_GT(sensor["share"], 0.99);
    EXPECT_LE(sensor["share"], 1.0);
    EXPECT_EQ(sensor["has_rings"], true);
    EXPECT_EQ(sensor["columns"], 870);
    EXPECT_THAT(test::readFile(path("again/sensor.yaml")), Not(HasSubstr("elevations_deg")));
}

TEST_F(RawlogSegment, SaysThatACloudHasNoBeamsOrTooFewReturns) {
    test::Random random(1);
    Scan scan;
    for (int i = 0; i < 5000; ++i) {
        scan.x_m.push_back(random.real(2, 9));
        scan.y_m.push_back(random.real(-9, 9));
        scan.z_m.push_back(random.real(-2, 2));
    }
    scan.intensity.assign(scan.size(), 0.5f);
    fs::create_directories(path("scans/velodyne"));
    recordings::writeScan(path("scans/velodyne/000000.bin"), scan);
    const auto none = run({"-i", path("scans"), "--stats", path("a.json")});
    EXPECT_THAT(none.out, HasSubstr("sensor velodyne: no beams found: "));
    EXPECT_THAT(none.out, HasSubstr(" virtual rows\n"));
    EXPECT_EQ(statistics("a.json")["recovered_sensors"]["velodyne"]["has_rings"], false);

    for (auto* coordinate : {&scan.x_m, &scan.y_m, &scan.z_m, &scan.intensity})
        coordinate->resize(399);
    recordings::writeScan(path("scans/velodyne/000000.bin"), scan);
    const auto few = run({"-i", path("scans"), "--stats", path("b.json")});
    EXPECT_EQ(few.exit_code, 0) << few.err;
    EXPECT_THAT(few.out, HasSubstr("sensor velodyne: too few returns"));
    EXPECT_THAT(few.out, HasSubstr("VLP-16 assumed"));
}

TEST_F(RawlogSegment, RemarksOnBeamsThatAreOnlyPartlyThoseOfTheCloud) {
    ASSERT_EQ(run({"-i", kRecording, "--kitti", path("scans")}).exit_code, 0);
    // Five of sixteen beams are a degree too high.
    folder_.write("scans/sensor.yaml",
                  "sensor: {model: custom, elevations_deg: [-15, -13, -10, -9, -7, -4, -3, -1, 2, "
                  "3, 5, 8, 9, 11, 14, 15]}\n");
    const auto outcome = run({"-i", path("scans"), "--kitti", path("labels")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("of 16 beams in view, the cloud shows 11, besides 5 others. "
                                       "Is it this sensor?"));
}

TEST_F(RawlogSegment, RemarksThatTheFoldersOwnSensorOverridesTheSettings) {
    ASSERT_EQ(run({"-i", kRecording, "--kitti", path("scans")}).exit_code, 0);
    const auto outcome =
        run({"-i", path("scans"), "--kitti", path("labels"), "-c", kConfig + "hdl64e.yaml"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("its sensor.yaml is used instead of the settings' "
                                       "sensor.model HDL-64E"));
}

TEST_F(RawlogSegment, RemarksThatNothingIsRoi) {
    test::Random random(1);
    Scan scan;
    for (int i = 0; i < 1000; ++i) {  // in the frame of a map
        scan.x_m.push_back(random.real(130, 150));
        scan.y_m.push_back(random.real(-60, -40));
        scan.z_m.push_back(random.real(10, 14));
    }
    scan.intensity.assign(scan.size(), 0.5f);
    fs::create_directories(path("scans/velodyne"));
    recordings::writeScan(path("scans/velodyne/000000.bin"), scan);
    const auto outcome = run({"-i", path("scans"), "--kitti", path("labels")});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("no return is RoI"));
    EXPECT_THAT(outcome.err, HasSubstr("relative to the sensor"));
}

TEST_F(RawlogSegment, FailsWhereTheCloudIsNotThatOfTheSensorNamed) {
    ASSERT_EQ(run({"-i", kRecording, "--kitti", path("scans")}).exit_code, 0);
    fs::remove(path("scans/sensor.yaml"));
    const auto outcome =
        run({"-i", path("scans"), "--kitti", path("labels"), "-c", kConfig + "hdl64e.yaml"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr(path("scans") + ": "));
    EXPECT_THAT(outcome.err, HasSubstr(" % of the cloud fits HDL-64E with its 64 beams"));
    EXPECT_THAT(outcome.err, HasSubstr("'sensor: {model: recovered}'"));
    EXPECT_FALSE(fs::exists(path("labels")));

    // Elevations in radians.
    folder_.write("scans/sensor.yaml",
                  "sensor: {model: custom, elevations_deg: [-0.26, -0.22, -0.19, -0.15, -0.12, "
                  "-0.08, -0.05, -0.01, 0.01, 0.05, 0.08, 0.12, 0.15, 0.19, 0.22, 0.26]}\n");
    EXPECT_THAT(run({"-i", path("scans"), "--kitti", path("labels")}).err,
                HasSubstr("its elevations are not in degrees"));
}

TEST_F(RawlogSegment, PacketsKnowTheirSensorEvenIfSettingsWantItRecovered) {
    const auto recover = folder_.write("recover.yaml", "sensor: {model: recovered}\n");
    const auto outcome = run({"-i", kRecording, "-o", path("out"), "-c", recover});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out, HasSubstr("sensor lidar: VLP-16, 16 beams\n"));
}

TEST_F(RawlogSegment, FailsWhereRecoveredBeamsDoNotFitTheSettings) {
    Scan scan;
    for (int column = 0; column < 400; ++column) {
        for (const float slope : {-0.3f, -0.2f, -0.1f, 0.1f}) {
            const float azimuth_rad = 0.0157f * static_cast<float>(column);
            scan.x_m.push_back(9 * std::cos(azimuth_rad));
            scan.y_m.push_back(9 * std::sin(azimuth_rad));
            scan.z_m.push_back(9 * slope);
        }
    }
    scan.intensity.assign(scan.size(), 0.5f);
    fs::create_directories(path("scans/velodyne"));
    recordings::writeScan(path("scans/velodyne/000000.bin"), scan);
    EXPECT_THAT(run({"-i", path("scans"), "--stats", path("a.json")}).out,
                HasSubstr("4 beams recovered, "));
    const auto window = folder_.write("window.yaml", "window_size: 8\n");
    const auto outcome = run({"-i", path("scans"), "--stats", path("b.json"), "-c", window});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("window_size (8)"));
    EXPECT_FALSE(fs::exists(path("b.json")));
    const auto limits = folder_.write("limits.yaml", "sensor: {min_range_m: 1000}\n");
    const auto empty = run({"-i", path("scans"), "--stats", path("b.json"), "-c", limits});
    EXPECT_EQ(empty.exit_code, 2);
    EXPECT_THAT(empty.err, HasSubstr("min_range_m"));
}

TEST_F(RawlogSegment, ARemarkThatComesWithEveryScanIsPrintedOnce) {
    const auto elsewhen = folder_.write("elsewhen.tum", "0 0 0 0 0 0 0 1\n");
    const auto outcome = run({"-i", kRecording, "--kitti", path("out"), "--poses", elsewhen});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("entry 1 (lidar): no pose near its time"));
    EXPECT_THAT(outcome.err, HasSubstr("the same for 9 more"));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 2) << outcome.err;
}

TEST_F(RawlogSegment, QuietPrintsNothing) {
    const auto outcome = run({"-q", "-i", kRecording, "-o", path("out")});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(RawlogSegment, OverwriteReplacesWhatIsThere) {
    folder_.write("out.rawlog", "old");
    folder_.write("scans/velodyne/000077.bin", "old");
    folder_.write("scans/labels/made_by.txt", "old");
    ASSERT_EQ(
        run({"-i", kRecording, "-o", path("out.rawlog"), "--kitti", path("scans"), "--overwrite"})
            .exit_code,
        0);
    EXPECT_GT(fs::file_size(path("out.rawlog")), 1000u);
    EXPECT_FALSE(fs::exists(path("scans/velodyne/000077.bin")));
}

/// A folder that somebody labelled by hand has the same names.
TEST_F(RawlogSegment, OverwriteReplacesNoFolderOfSomebodyElse) {
    folder_.write("mine/velodyne/000000.bin", "mine");
    folder_.write("mine/labels/000000.label", "mine");
    const auto outcome = run({"-i", kRecording, "--kitti", path("mine"), "--overwrite"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("mine: is not a scan folder of an earlier run, so it is "
                                       "not replaced"));
    EXPECT_EQ(test::readFile(path("mine/labels/000000.label")), "mine");
}

/// What MRPT stores beside a rawlog is a part of the recording.
TEST_F(RawlogSegment, OverwriteReplacesNothingOfTheInput) {
    fs::copy_file(kRecording, path("flight.rawlog"));
    folder_.write("flight_Images/cloud_1.bin", "mine");
    const auto outcome = run(
        {"-i", path("flight.rawlog"), "--stats", path("flight_Images/cloud_1.bin"), "--overwrite"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("flight_Images"));
    EXPECT_EQ(test::readFile(path("flight_Images/cloud_1.bin")), "mine");
}

TEST_F(RawlogSegment, HelpAndVersionAreNoFailures) {
    const auto outcome = run({"--help"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(run({"--version"}).exit_code, 0);
    EXPECT_THAT(run({"--version"}).out, HasSubstr("rawlog-segment 0."));
    EXPECT_THAT(outcome.out, HasSubstr("--kitti"));
}

TEST_F(RawlogSegment, ListsEveryKeyOfSettingsFiles) {
    const auto outcome = run({"--config-keys"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    for (const OptionKey& key : optionKeys()) {
        EXPECT_THAT(outcome.out, HasSubstr("\n| " + nameInFiles(key) + " ")) << key.name;
        EXPECT_THAT(outcome.out, HasSubstr(key.what)) << key.name;
    }
}

TEST_F(RawlogSegment, WithoutALidarItCopiesAndSaysSo) {
    const fs::path log = "/usr/share/mrpt/datasets/localization_demo.rawlog";
    if (!fs::exists(log)) GTEST_SKIP() << "mrpt-common is not installed";
    const auto outcome = run({"-i", log, "-o", path("out.rawlog"), "--kitti", path("scans"),
                              "--pictures", path("pictures")});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("no LiDAR scan"));
    EXPECT_FALSE(fs::exists(path("scans")));
    EXPECT_FALSE(fs::exists(path("pictures")));
    recordings::RawlogReader in(log), out(path("out.rawlog"));
    while (in.next()) ASSERT_NE(out.next(), nullptr);
    EXPECT_EQ(out.next(), nullptr);
}

// The published filter's RoI and ROU of each scan of the recording. (The last bit of a sine may
// differ between machines, and therefore a few returns.)
constexpr int kGolden[10][2] = {{1730, 13883}, {1857, 13775}, {1864, 13767}, {1894, 13753},
                                {1897, 13754}, {1967, 13751}, {2057, 13724}, {2066, 13735},
                                {2070, 13736}, {2127, 13707}};

TEST_F(RawlogSegment, StockMrptReadsTheSegmentedRecordingWithPreviews) {
    ASSERT_EQ(
        run({"-i", kRecording, "-o", path("out.rawlog"), "--preview", "-c", kPaper}).exit_code, 0);
    mrpt::obs::CRawlog rawlog;
    ASSERT_TRUE(rawlog.loadFromRawLogFile(path("out.rawlog")));
    ASSERT_EQ(rawlog.size(), 51u);
    for (std::size_t scan = 0; scan < 10; ++scan) {
        for (const std::size_t part : {0, 1}) {
            const auto cloud = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(
                rawlog.getAsObservation(5 * scan + 2 + part));
            ASSERT_NE(cloud, nullptr);
            EXPECT_NEAR(static_cast<double>(cloud->pointcloud->size()), kGolden[scan][part], 5);
        }
        EXPECT_EQ(rawlog.getAsObservation(5 * scan + 4)->GetRuntimeClass()->className,
                  std::string("mrpt::obs::CObservation3DScene"));
    }
    if (!fs::exists("/usr/bin/rawlog-edit")) GTEST_SKIP() << "mrpt-apps is not installed";
    const auto info = test::run("/usr/bin/rawlog-edit", {"-i", path("out.rawlog"), "--info"});
    EXPECT_EQ(info.exit_code, 0);
    EXPECT_THAT(info.out, HasSubstr("Overall number of objects         : 51\n"));
    EXPECT_THAT(info.out, HasSubstr("lidar_non_roi /     10"));
    EXPECT_THAT(info.out, HasSubstr("lidar_roi /     10"));
}

TEST_F(RawlogSegment, WritesStatisticsThatAddUp) {
    ASSERT_EQ(run({"-i", kRecording, "--stats", path("a.json"), "-c", kPaper}).exit_code, 0);
    const auto json = nlohmann::json::parse(test::readFile(path("a.json")));
    EXPECT_EQ(json["entries"], 21);
    EXPECT_EQ(json["settings"]["beta_deg"], 10);
    EXPECT_EQ(json["settings"]["seeds"], "lowest");
    EXPECT_EQ(json["returns"]["all"], 157114);
    ASSERT_EQ(json["scans"].size(), 10u);
    int returns = 0;
    for (std::size_t i = 0; i < 10; ++i) {
        const auto& scan = json["scans"][i];
        EXPECT_EQ(scan["entry"], 2 * i + 1);
        EXPECT_NEAR(scan["roi"].get<double>(), kGolden[i][0], 5);
        returns +=
            scan["roi"].get<int>() + scan["rou"].get<int>() + scan["unclassified"].get<int>();
        EXPECT_GT(scan["nearest_roi_m"], 5.0);  // all poles are farther away
    }
    EXPECT_EQ(returns, 157114);
    EXPECT_EQ(json["latency_ms"]["scans"], 10);
    EXPECT_LE(json["latency_ms"]["p50"], json["latency_ms"]["max"]);
}

TEST_F(RawlogSegment, ConvertsAPartOfALog) {
    const auto outcome =
        run({"-i", kRecording, "-o", path("out.rawlog"), "--from", "3", "--to", "6"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("2 LiDAR scans in 4 entries (3 to 6 of the input"));
    recordings::RawlogReader reader(path("out.rawlog"));
    while (reader.next()) {
    }
    EXPECT_EQ(reader.entries(), 8u);
}

TEST_F(RawlogSegment, PosesTravelWithTheScans) {
    // The same poses, from the log and from a file.
    ASSERT_EQ(run({"-i", kRecording, "--kitti", path("a"), "-c", kPaper}).exit_code, 0);
    std::string poses;
    for (int i = 0; i <= 10; ++i) {
        char line[80];
        std::snprintf(line, sizeof line, "%.6f %.6f 0 1.2 0 0 0 1\n", 1767225600 + 0.1 * i,
                      0.3 * i);
        poses += line;
    }
    const auto tum = folder_.write("flight.tum", poses);
    const auto outcome =
        run({"-i", kRecording, "--kitti", path("b"), "-c", kPaper, "--poses", tum});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out, HasSubstr("poses of 10 of 10 scans: " + tum.string()));
    const auto a = recordings::readTumPoses(path("a/poses.tum"));
    const auto b = recordings::readTumPoses(path("b/poses.tum"));
    ASSERT_EQ(a.size(), 10u);
    ASSERT_EQ(b.size(), 10u);
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_NEAR((a[i].pose - b[i].pose).norm(), 0.0, 1e-3);
        EXPECT_NEAR(b[i].pose.x(), 0.3 * static_cast<double>(i), 1e-3);
    }
    // Each scan is segmented alone, in its own frame: poses change no label.
    EXPECT_EQ(test::readFile(path("a/labels/000009.label")),
              test::readFile(path("b/labels/000009.label")));
}

TEST_F(RawlogSegment, SaysWherePosesAreNotUsed) {
    const auto kitti = folder_.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
    const auto outcome = run({"-i", kRecording, "-o", path("out.rawlog"), "--poses", kitti});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("poses.txt: ignored"));
}

TEST_F(RawlogSegment, CloudsKeepIntensitiesWhereAsked) {
    ASSERT_EQ(run({"-i", kRecording, "-o", path("out.rawlog"), "--cloud", "xyzi"}).exit_code, 0);
    mrpt::obs::CRawlog rawlog;
    ASSERT_TRUE(rawlog.loadFromRawLogFile(path("out.rawlog")));
    const auto roi =
        std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(rawlog.getAsObservation(2));
    EXPECT_EQ(roi->pointcloud->GetRuntimeClass()->className,
              std::string("mrpt::maps::CPointsMapXYZI"));
}

TEST_F(RawlogSegment, DrawsTheStagesOfAScan) {
    const auto outcome = run({"-i", kRecording, "--pictures", path("pictures"), "--from", "1",
                              "--to", "1", "--picture-azimuth", "-90"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const char* name : {"1_depth.png", "2_maxima.png", "3_merged.png", "4_range_angle.png",
                             "5_smoothed.png", "6_labels.png", "7_top_view.png", "stages.png"}) {
        EXPECT_GT(fs::file_size(folder_ / "pictures/000001" / name), 5000u) << name;
    }
}

TEST_F(RawlogSegment, DrawsTheStagesOfASensorThatIsNotUpright) {
    const std::string settings = path("settings.yaml");
    for (const char* mount : {"mount_pitch_deg: 60", "mount_roll_deg: 180"}) {
        std::ofstream(settings) << "sensor:\n  model: VLP-16\n  " << mount << "\n";
        const auto outcome = run({"-i", kRecording, "--pictures", path("pictures"), "--from", "1",
                                  "--to", "1", "-c", settings, "--overwrite"});
        ASSERT_EQ(outcome.exit_code, 0) << mount << outcome.err;
        EXPECT_GT(fs::file_size(folder_ / "pictures/000001/stages.png"), 5000u) << mount;
    }
}

TEST_F(RawlogSegment, ZeroPacketsAndPointsThatAreNotFiniteLoseNothing) {
    auto empty = mrpt::obs::CObservationVelodyneScan::Create();
    empty->sensorLabel = "empty";
    Scan scan;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    scan.x_m = {5, nan, inf, 0};
    scan.y_m = scan.z_m = {0, 1, 1, 0};
    scan.intensity = {0, 0, 0, 0};
    convert::RawlogWriter writer(path("in.rawlog"), false);
    writer.write(*empty);
    writer.write(*observations::observationOf(scan, "cloud", mrpt::Clock::fromDouble(1.0)));
    writer.commit();
    const auto outcome =
        run({"-i", path("in.rawlog"), "-o", path("out.rawlog"), "--kitti", path("scans")});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("entry 0 (empty): the scan has no packets"));
    EXPECT_THAT(outcome.out, HasSubstr("2 LiDAR scans in 2 entries, 4 returns"));
    const auto labels = recordings::readLabels(path("scans/cloud/labels/000000.label"));
    EXPECT_EQ(std::vector<std::uint16_t>(labels.begin() + 1, labels.end()),
              (std::vector<std::uint16_t>{0, 0, 0}));
}

TEST_F(RawlogSegment, DumpsTheSettingsInForce) {
    const auto mine = folder_.write("mine.yaml", "beta_deg: 7.5\n");
    const auto outcome = run({"--config-dump", "-c", kPaper, "-c", mine});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.out, HasSubstr("beta_deg: 7.5 "));
    EXPECT_THAT(outcome.out, HasSubstr("# [deg]"));
    EXPECT_EQ(run({"--config-dump", "-c", folder_.write("dump.yaml", outcome.out)}).out,
              outcome.out);
}

TEST_F(RawlogSegment, ThePageOfSettingsIsTheParsersOwnTable) {
    const std::string page = test::readFile(fs::path(HAGEN_SOURCE_DIR) / "docs/settings.md");
    EXPECT_THAT(page, HasSubstr(run({"--config-keys"}).out))
        << "put the output of rawlog-segment --config-keys into docs/settings.md";
}

// Wrong usage: exit code 2.

TEST_F(RawlogSegment, RefusesToRunWithoutInputOrOutput) {
    expectFailure({}, 2, "--input");
    expectFailure({"-i", kRecording}, 2, "an output (-o, --kitti");
}

TEST_F(RawlogSegment, RefusesOutputsWithoutAName) {
    expectFailure({"-i", kRecording, "-o", ""}, 2, "must not be empty");
    expectFailure({"-i", kRecording, "--kitti", ""}, 2, "must not be empty");
}

TEST_F(RawlogSegment, RefusesUnknownFlags) {
    expectFailure({"-i", kRecording, "-o", path("out"), "--fast"}, 2, "--fast");
}

TEST_F(RawlogSegment, SaysWhereAValueWithoutAFlagBelongs) {
    const std::string log = kRecording;
    expectFailure({log, "-o", path("out")}, 2, "not expected: " + log + "; use -i " + log);
    expectFailure({"-o", path("out"), log}, 2, "use -i " + log);
    expectFailure(
        {"-i", log, "--stats", path("out"), "--topic", "/a", "/b", "/c"}, 2,
        "were not expected: /b, /c; to name several, repeat the flag: --topic /a --topic /b");
    expectFailure({"-i", log, path("out")}, 2, "not expected: " + path("out") + "\n");
    expectFailure({"--topik", "/a"}, 2, "not expected: --topik, /a\n");
}

TEST_F(RawlogSegment, RefusesAnInputThatIsNotThere) {
    expectFailure({"-i", path("none.rawlog"), "-o", path("out")}, 2, path("none.rawlog"));
}

TEST_F(RawlogSegment, RefusesMisspeltSettingsWithTheNearestKey) {
    const auto file = folder_.write("mine.yaml", "zone: 20\n");
    expectFailure({"-i", kRecording, "-o", path("out"), "-c", file}, 2, "'zone_m'");
}

TEST_F(RawlogSegment, RefusesAWindowOfSeveralScansAndSaysWhatToDo) {
    const auto file = folder_.write("old.yaml", "window_scans: 3\n");
    expectFailure({"-i", kRecording, "-o", path("out"), "-c", file}, 2,
                  "old.yaml:1: window_scans was removed");
}

TEST_F(RawlogSegment, RefusesSettingsOutOfRangeOrOfAnotherSensor) {
    const auto beta = folder_.write("beta.yaml", "beta_deg: 100\n");
    expectFailure({"-i", kRecording, "-o", path("out"), "-c", beta}, 2, "beta_deg is 100");
    const auto window = folder_.write("window.yaml", "window_size: 20\n");
    expectFailure({"-i", kRecording, "-o", path("out"), "-c", window}, 2, "window_size (20)");
}

TEST_F(RawlogSegment, RefusesASettingsFileThatIsNotThere) {
    expectFailure({"-i", kRecording, "-o", path("out"), "-c", path("none.yaml")}, 2, "none.yaml");
}

TEST_F(RawlogSegment, RefusesFlagsThatContradictOneAnother) {
    expectFailure({"-i", kRecording, "-o", path("out"), "--from", "5", "--to", "4"}, 2, "--from");
    expectFailure({"-i", kRecording, "-o", path("out"), "--from", "-1"}, 2, "--from");
    expectFailure({"-i", kRecording, "-o", path("out"), "--jobs", "0"}, 2, "--jobs");
    expectFailure({"-i", kRecording, "--kitti", path("out"), "--preview"}, 2, "--output");
    expectFailure({"-i", kRecording, "-o", path("out"), "--cloud", "rgb"}, 2, "--cloud");
    expectFailure({"-i", kRecording, "-o", path("out"), "--picture-azimuth", "3"}, 2, "--pictures");
    expectFailure({"-i", kRecording, "-o", path("out"), "--poses", path("none.tum")}, 2,
                  "none.tum");
}

// Failures while running: exit code 1.

TEST_F(RawlogSegment, FailsWhereTheOutputExists) {
    folder_.write("out.rawlog", "old");
    expectFailure({"-i", kRecording, "-o", path("out.rawlog")}, 1, "--overwrite");
    EXPECT_EQ(test::readFile(path("out.rawlog")), "old");
}

TEST_F(RawlogSegment, FailsWhereNoScanCanBeReadAndSaysWhyEvenWhenQuiet) {
    const auto scan = test::polesAndWallScan(0);
    scan->scan_packets[0].velodyne_model_ID = 0x99;
    convert::RawlogWriter writer(path("in.rawlog"), false);
    writer.write(*scan);
    writer.commit();
    const auto outcome = run({"-q", "-i", path("in.rawlog"), "-o", path("out.rawlog")});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(
        outcome.err,
        HasSubstr("entry 0 (lidar): kept, but not segmented: packet 0: unknown model id 0x99"));
}

TEST_F(RawlogSegment, FailsOnAnEmptyFile) {
    const auto file = folder_.write("empty.rawlog", "");
    expectFailure({"-i", file, "-o", path("out")}, 1, "is empty");
}

TEST_F(RawlogSegment, FailsOnWhatIsNoRawlog) {
    const auto file = folder_.write("text.rawlog", "this is no rawlog, whatever its name says\n");
    expectFailure({"-i", file, "-o", path("out")}, 1,
                  "text.rawlog: is no recording: it seems to be text. Known are rawlogs, captures");
    const auto picture = folder_.write("a.rawlog", "\x89PNG\r\n\x1a\n" + std::string(99, '\x81'));
    expectFailure({"-i", picture, "-o", path("out")}, 1, "it seems to be a PNG picture");
    const auto unknown = folder_.write("b.rawlog", std::string(99, '\x81'));
    expectFailure({"-i", unknown, "-o", path("out")}, 1, "bytes are none of a kind that is known");
}

TEST_F(RawlogSegment, FailsOnAFolderWithoutScans) {
    expectFailure({"-i", folder_.path(), "--kitti", path("out")}, 1, "velodyne");
}

TEST_F(RawlogSegment, FailsOnAScanThatIsCutOff) {
    folder_.write("scans/velodyne/000000.bin", "123");
    expectFailure({"-i", path("scans"), "--kitti", path("out")}, 1, "000000.bin");
}

TEST_F(RawlogSegment, FailsWhereTheOutputsFolderIsMissing) {
    expectFailure({"-i", kRecording, "-o", path("none/out.rawlog")}, 1, "no such folder");
}

TEST_F(RawlogSegment, FailsToReplaceItsInputOrAnythingThatHoldsIt) {
    const auto copy = folder_.write("logs/in.rawlog", test::readFile(kRecording));
    expectFailure({"-i", copy, "-o", copy, "--overwrite"}, 1, "is or contains the input");
    expectFailure({"-i", copy, "--kitti", path("logs"), "--overwrite"}, 1,
                  "is or contains the input");
    expectFailure({"-i", copy, "--kitti", path("logs/"), "--overwrite"}, 1,
                  "is or contains the input");
    ASSERT_EQ(run({"-i", kRecording, "--kitti", path("scans")}).exit_code, 0);
    expectFailure({"-i", path("scans"), "--kitti", path("scans"), "--overwrite"}, 1,
                  "is or contains the input");
    expectFailure({"-i", path("scans"), "--kitti", path("scans/velodyne"), "--overwrite"}, 1,
                  "is in the input");
}

TEST_F(RawlogSegment, FailsToReplaceWhatIsNotItsOwn) {
    folder_.write("work/src/main.cpp", "");
    expectFailure({"-i", kRecording, "--kitti", path("work"), "--overwrite"}, 1, "'src/main.cpp'");
    expectFailure({"-i", kRecording, "-o", path("work"), "--overwrite"}, 1, "not a file");
    expectFailure({"-i", kRecording, "-o", "/dev/null", "--overwrite"}, 1, "not a file");
    folder_.write("notes.txt", "mine");
    expectFailure({"-i", kRecording, "--kitti", path("notes.txt"), "--overwrite"}, 1,
                  "not a folder");
    EXPECT_EQ(test::readFile(path("notes.txt")), "mine");
}

TEST_F(RawlogSegment, FailsWhereOneOutputLiesInTheOther) {
    expectFailure({"-i", kRecording, "-o", path("same"), "--kitti", path("same")}, 1,
                  "use separate paths");
    expectFailure({"-i", kRecording, "-o", path("same/x"), "--kitti", path("same")}, 1,
                  "use separate paths");
}

TEST_F(RawlogSegment, KeepsTheGoodPartOfALogThatBreaksOff) {
    const std::string bytes = test::readFile(kRecording);
    const auto cut = folder_.write("cut.rawlog", bytes.substr(0, bytes.size() / 2));
    const auto outcome = run({"-i", cut, "-o", path("out.rawlog")});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("cut.rawlog: entry"));
    EXPECT_THAT(outcome.err, HasSubstr("out.partial.rawlog"));
    EXPECT_FALSE(fs::exists(path("out.rawlog")));
    recordings::RawlogReader reader(path("out.partial.rawlog"));
    while (reader.next()) {
    }
    EXPECT_GE(reader.entries(), 12u);
}

TEST_F(RawlogSegment, FailsOnASensorLabelThatIsNotThere) {
    expectFailure({"-i", kRecording, "-o", path("out"), "--sensor-label", "lidra"}, 1,
                  "no converted entry has a LiDAR scan of 'lidra'; there are 'lidar'");
}

TEST_F(RawlogSegment, FailsWhereThereIsNoEntryToConvert) {
    expectFailure({"-i", kRecording, "-o", path("out"), "--from", "21"}, 1,
                  "has 21 entries, none at or after 21");
}

TEST_F(RawlogSegment, FailsOnPosesThatAreNone) {
    const auto poses = folder_.write("poses.tum", "1 2 3\n");
    expectFailure({"-i", kRecording, "--kitti", path("out"), "--poses", poses}, 1, "poses.tum:1");
}

TEST_F(RawlogSegment, FailsWhereTheFolderCannotBeWrittenTo) {
    expectFailure({"-i", kRecording, "-o", "/proc/self/out"}, 1, "/proc/self/out");
    expectFailure({"-i", kRecording, "--kitti", "/proc/self/out"}, 1, "/proc/self/out");
    if (geteuid() == 0) GTEST_SKIP() << "root writes everywhere else";
    fs::create_directory(folder_ / "locked");
    fs::permissions(folder_ / "locked", fs::perms::owner_read | fs::perms::owner_exec);
    expectFailure({"-i", kRecording, "-o", path("locked/out")}, 1, "Permission denied");
    expectFailure({"-i", kRecording, "--kitti", path("locked/out")}, 1, "Permission denied");
}

TEST_F(RawlogSegment, FailsWithoutATraceWhereTheDiskIsFull) {
    // A file size limit of 64 kB simulates a full disk.
    const auto limited = [&](const std::string& outputs) {
        return test::run("/bin/bash", {"-c", "trap \"\" XFSZ; ulimit -f 64; exec " +
                                                 std::string(HAGEN_RAWLOG_SEGMENT) + " -i " +
                                                 kRecording.string() + " " + outputs});
    };
    for (const std::string& outputs : {"-o " + path("out.rawlog"), "--kitti " + path("scans"),
                                       "--pictures " + path("pictures")}) {
        const auto outcome = limited(outputs);
        EXPECT_EQ(outcome.exit_code, 1) << outputs << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("rawlog-segment: "));
        EXPECT_THAT(outcome.err,
                    AnyOf(HasSubstr("cannot be written"), HasSubstr("File too large")));
        EXPECT_TRUE(fs::is_empty(folder_.path())) << outputs;
    }
}

TEST_F(RawlogSegment, KeepsWhatIsDoneWhenItIsInterrupted) {
    // Concatenated gzip files are one log; converting it takes many times as long as the wait.
    const std::string bytes = test::readFile(kRecording);
    std::string many;
    for (int i = 0; i < 200; ++i) many += bytes;
    const auto log = folder_.write("long.rawlog", many);
    for (const char* signal : {"INT", "TERM"}) {
        const auto outcome = test::run(
            "/usr/bin/timeout", {"--preserve-status", "-s", signal, "1", HAGEN_RAWLOG_SEGMENT, "-i",
                                 log, "-o", path("out.rawlog"), "--overwrite", "--jobs", "2"});
        EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("interrupted; the "));
        EXPECT_FALSE(fs::exists(path("out.rawlog")));
        recordings::RawlogReader reader(path("out.partial.rawlog"));
        while (reader.next()) {
        }
        EXPECT_GT(reader.entries(), 4u);
        fs::remove(path("out.partial.rawlog"));
        EXPECT_EQ(files(), std::set<fs::path>{log});
    }
}

// The recording itself.

// The published filter's reference result: a change must be intended, or is a bug. (The last bit of
// a sine may differ between machines, and therefore a few returns.)
TEST_F(RawlogSegment, ThePublishedFilterLabelsTheRecordingAsBefore) {
    const auto outcome = run({"-i", kRecording, "--kitti", path("scans"), "-c", kPaper});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const recordings::ScanFolder scans(path("scans"));
    std::size_t returns = 0, roi = 0;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const auto labels = recordings::readLabels(scans.labelFile(i));
        returns += labels.size();
        roi += static_cast<std::size_t>(std::count(labels.begin(), labels.end(), 2));
    }
    EXPECT_EQ(returns, 157114u);
    EXPECT_NEAR(static_cast<double>(roi), 19529.0, 40.0);
}

TEST(PolesAndWall, TheRecordingIsWhatItsGeneratorMakes) {
    recordings::RawlogReader reader(kRecording);
    for (int scan = 0; scan < test::kPolesAndWallScans; ++scan) {
        ASSERT_NE(reader.next(), nullptr);
        const auto recorded =
            std::dynamic_pointer_cast<mrpt::obs::CObservationVelodyneScan>(reader.next());
        const auto made = test::polesAndWallScan(scan);
        ASSERT_NE(recorded, nullptr);
        ASSERT_EQ(recorded->scan_packets.size(), made->scan_packets.size());
        for (std::size_t p = 0; p < made->scan_packets.size(); ++p) {
            for (int b = 0; b < 12; ++b) {
                for (int i = 0; i < 32; ++i) {
                    // The last bit of a sine may differ between machines, and a range by one unit.
                    ASSERT_NEAR(recorded->scan_packets[p].blocks[b].laser_returns[i].distance(),
                                made->scan_packets[p].blocks[b].laser_returns[i].distance(), 1);
                }
            }
        }
    }
    EXPECT_NE(reader.next(), nullptr);  // the last pose
    EXPECT_EQ(reader.next(), nullptr);
}

}  // namespace
}  // namespace hagen
