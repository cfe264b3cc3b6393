// rawlog-segment on rawlogs and scan folders, run as a user would.
#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/ScanFolder.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CRawlog.h>
#include <unistd.h>
#include "convert/RawlogWriter.h"
#include "filter/OptionKeys.h"

#include <cmath>
#include <limits>

#include "support/Random.h"
#include "support/ReadRawlog.h"
#include "support/SegmentTest.h"

namespace hagen {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

class RawlogSegment : public test::SegmentTest {
 protected:
    /// A scan folder of the sample recording.
    void writeScans() const { expectSuccess({"-q", "-i", recording(), "--kitti", path("scans")}); }
    void writeScan(Scan scan) const {
        scan.intensity.assign(scan.size(), 0.5f);
        fs::create_directories(path("scans/velodyne"));
        recordings::writeScan(path("scans/velodyne/000000.bin"), scan);
    }
};

Scan randomScan(int points, const Eigen::Vector3f& min_m, const Eigen::Vector3f& max_m) {
    test::Random random(1);
    Scan scan;
    for (int i = 0; i < points; ++i) {
        scan.x_m.push_back(random.real(min_m.x(), max_m.x()));
        scan.y_m.push_back(random.real(min_m.y(), max_m.y()));
        scan.z_m.push_back(random.real(min_m.z(), max_m.z()));
    }
    return scan;
}

// RoI and ROU counts of the published filter for each scan of the recording. Sines may differ in
// the last bit between machines, and therefore a few labels.
constexpr int kGolden[10][2] = {{1730, 13883}, {1857, 13775}, {1864, 13767}, {1894, 13753},
                                {1897, 13754}, {1967, 13751}, {2057, 13724}, {2066, 13735},
                                {2070, 13736}, {2127, 13707}};

TEST_F(RawlogSegment, AcceptsInputWithoutFlagAndSingleKeys) {
    const auto outcome =
        expectSuccess({recording(), "--stats", "-", "--set", "zone_m=7", "--set", "seeds=every"});
    const auto stats = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(stats["settings"]["zone_m"], 7);
    EXPECT_EQ(stats["settings"]["seeds"], "every");
    EXPECT_FALSE(fs::exists("-"));
    test::run("/bin/bash", {"-c", "echo first >\"$1\"; \"$0\" \"$2\" --stats - >>\"$1\"",
                            HAGEN_RAWLOG_SEGMENT, path("log"), recording()});
    EXPECT_THAT(test::readFile(path("log")), testing::StartsWith("first\n{"));
    fs::remove(path("log"));
    expectFailure({"-i", recording(), "--stats", "-", "-c", "zone_m=7"}, 2, "--set zone_m=7");
    expectFailure({"-i", recording(), "-o", path("out.mcap")}, 2, "does not end in .rawlog");
}

TEST_F(RawlogSegment, WarnsIfUpsideDown) {
    expectSuccess({"-q", "-i", recording(), "--kitti", path("scans")});
    for (const auto& file : fs::directory_iterator(path("scans/velodyne"))) {
        Scan scan;
        recordings::readScan(file.path(), scan);
        for (float& y_m : scan.y_m) y_m = -y_m;
        for (float& z_m : scan.z_m) z_m = -z_m;
        recordings::writeScan(file.path(), scan);
    }
    fs::remove(path("scans/poses.tum"));  // these have an attitude
    const Arguments convert{"-i", path("scans"), "--stats", path("a.json")};
    EXPECT_THAT(expectSuccess(convert).err,
                HasSubstr("no ground was found in 10 of 10 scans: all their returns within 20 m "
                          "count as obstacles. With --set sensor.mount_roll_deg=180, 10 of 10"));
    EXPECT_EQ(
        expectSuccess(with(convert, {"--overwrite", "--set", "sensor.mount_roll_deg=180"})).err,
        "");
}

TEST_F(RawlogSegment, LabelsSampleRecordingAsPublished) {
    const auto outcome =
        expectSuccess({"-i", recording(), "-o", path("out.rawlog"), "--preview", "--kitti",
                       path("scans"), "--stats", path("a.json"), "-c", config("paper")});
    EXPECT_THAT(outcome.out, HasSubstr("10 LiDAR scans in 21 entries"));
    EXPECT_THAT(outcome.out, HasSubstr("sensor lidar: VLP-16, 16 beams\n"));
    EXPECT_THAT(outcome.out, HasSubstr(path("out.rawlog")));
    EXPECT_EQ(outcome.err, "");

    mrpt::obs::CRawlog rawlog;  // MRPT's own reader
    ASSERT_TRUE(rawlog.loadFromRawLogFile(path("out.rawlog")));
    ASSERT_EQ(rawlog.size(), 51u);
    const auto stats = readJson("a.json");
    ASSERT_EQ(stats["scans"].size(), 10u);
    const recordings::ScanFolder scans(path("scans"));
    int returns = 0;
    for (std::size_t i = 0; i < 10; ++i) {
        const auto entry = [&](std::size_t k) { return rawlog.getAsObservation(5 * i + k); };
        EXPECT_EQ(entry(0)->sensorLabel, "pose");
        EXPECT_EQ(entry(1)->sensorLabel, "lidar");
        for (const std::size_t part : {0, 1}) {
            const auto cloud =
                std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(entry(2 + part));
            ASSERT_NE(cloud, nullptr);
            EXPECT_EQ(cloud->sensorLabel, part == 0 ? "lidar_roi" : "lidar_non_roi");
            EXPECT_EQ(cloud->timestamp, entry(1)->timestamp);
            EXPECT_NEAR(static_cast<double>(cloud->pointcloud->size()), kGolden[i][part], 5);
        }
        EXPECT_EQ(entry(4)->GetRuntimeClass()->className,
                  std::string("mrpt::obs::CObservation3DScene"));
        const auto& scan = stats["scans"][i];
        EXPECT_EQ(scan["scan"], i);
        EXPECT_GT(scan["nearest_roi_m"], 5.0);  // all poles are farther than this
        const auto labels = recordings::readLabels(scans.labelFile(i));
        EXPECT_EQ(scan["roi"], std::count(labels.begin(), labels.end(), 2));
        EXPECT_EQ(scan["returns"], labels.size());
        returns +=
            scan["roi"].get<int>() + scan["rou"].get<int>() + scan["unclassified"].get<int>();
    }
    EXPECT_EQ(returns, 157114);
    EXPECT_EQ(stats["returns"]["all"], 157114);
    EXPECT_EQ(stats["entries"], 21);
    EXPECT_EQ(stats["settings"]["beta_deg"], 10);
    EXPECT_EQ(stats["settings"]["seeds"], "lowest");
    EXPECT_EQ(stats["recovered_sensors"], nlohmann::json::object());
    EXPECT_EQ(stats["latency_ms"]["scans"], 10);
    EXPECT_LE(stats["latency_ms"]["p50"], stats["latency_ms"]["max"]);
}

TEST_F(RawlogSegment, OutputsDoNotDependOnThreads) {
    const std::vector<std::string> outputs{".rawlog", ".mcap", ".bt", ".ot", ".3Dscene"};
    for (const std::string jobs : {"1", "3"}) {
        fs::create_directory(path(jobs));
        const std::string out = path(jobs) + "/out";
        expectSuccess(
            {"-q",        "-i",          recording(),           "-o",        out + ".rawlog",
             "--preview", "--kitti",     path(jobs + "/scans"), "--clouds",  path(jobs + "/clouds"),
             "--mcap",    out + ".mcap", "--octomap",           out + ".bt", "--octomap",
             out + ".ot", "--octomap",   out + ".3Dscene",      "--jobs",    jobs});
    }
    std::size_t compared = 0;
    for (const auto& entry : fs::recursive_directory_iterator(path("1"))) {
        if (!entry.is_regular_file()) continue;
        const fs::path name = entry.path().lexically_relative(path("1"));
        EXPECT_TRUE(test::readFile(entry) == test::readFile(path("3") / name)) << name;
        ++compared;
    }
    EXPECT_GT(compared, outputs.size() + 30);  // ten scans, each with labels and a cloud
}

TEST_F(RawlogSegment, RecoversUnnamedSensor) {
    writeScans();
    fs::remove(path("scans/sensor.yaml"));
    const Arguments flags{"-i",      path("scans"),  "--kitti",    path("again"),
                          "--stats", path("b.json"), "--overwrite"};
    EXPECT_THAT(
        run(with(flags, {"-c", config("vlp16")})).out,
        HasSubstr("sensor velodyne: VLP-16, 16 beams, 100.0 % of the returns lie on them\n"));
    const auto outcome = run(flags);
    EXPECT_THAT(outcome.out, HasSubstr("sensor velodyne: 16 beams recovered (VLP-16), "));
    EXPECT_THAT(outcome.out, HasSubstr(" % of the returns lie on them\n"));
    const auto sensor = readJson("b.json")["recovered_sensors"]["velodyne"];
    EXPECT_EQ(sensor["name"], "VLP-16");
    EXPECT_EQ(sensor["beams"], 16);
    EXPECT_EQ(sensor["beams_seen"], 16);
    EXPECT_GT(sensor["share"], 0.99);
    EXPECT_EQ(sensor["has_rings"], true);
    EXPECT_EQ(sensor["columns"], 870);
    const recordings::ScanFolder scans(path("again"));
    ASSERT_EQ(scans.size(), 10u);
    EXPECT_EQ(fs::file_size(scans.labelFile(3)) * 4, fs::file_size(scans.scanFile(3)));
    EXPECT_THAT(test::readFile(path("again/sensor.yaml")), Not(HasSubstr("elevations_deg")));
}

TEST_F(RawlogSegment, ReportsCloudsWithoutBeams) {
    writeScan(randomScan(5000, {2, -9, -2}, {9, 9, 2}));
    const auto none = run({"-i", path("scans"), "--stats", path("a.json")});
    EXPECT_THAT(none.out, HasSubstr("sensor velodyne: no beams found, using "));
    EXPECT_THAT(none.out, HasSubstr(" virtual rows\n"));
    EXPECT_EQ(readJson("a.json")["recovered_sensors"]["velodyne"]["has_rings"], false);

    writeScan(randomScan(399, {2, -9, -2}, {9, 9, 2}));
    const auto few = expectSuccess({"-i", path("scans"), "--stats", path("b.json")});
    EXPECT_THAT(few.out, HasSubstr("sensor velodyne: too few returns"));
    EXPECT_THAT(few.out, HasSubstr("assuming VLP-16"));

    writeScan(randomScan(1000, {130, -60, 10}, {150, -40, 14}));  // in map coordinates
    const auto far = expectSuccess({"-i", path("scans"), "--stats", path("c.json")});
    EXPECT_THAT(far.err, HasSubstr("no obstacle was found in 1 of 1 scan"));
    EXPECT_THAT(far.err, HasSubstr("relative to the sensor"));
}

TEST_F(RawlogSegment, ComparesCloudsWithNamedSensor) {
    writeScans();
    const Arguments flags{"-i", path("scans"), "--kitti", path("labels")};
    const auto overridden = expectSuccess(with(flags, {"-c", config("hdl64e")}));
    EXPECT_THAT(overridden.err, HasSubstr("sensor.yaml overrides the settings' "
                                          "sensor.model HDL-64E"));
    fs::remove_all(path("labels"));
    // Five of sixteen beams are one degree too high.
    folder_.write("scans/sensor.yaml",
                  "sensor: {model: custom, elevations_deg: [-15, -13, -10, -9, -7, -4, -3, -1, 2, "
                  "3, 5, 8, 9, 11, 14, 15]}\n");
    const auto partly = expectSuccess(flags);
    EXPECT_THAT(partly.err,
                HasSubstr("the cloud shows 11 of the 16 beams in view and 5 other beams. "
                          "Is it this sensor?"));
    fs::remove_all(path("labels"));

    folder_.write("scans/sensor.yaml",  // elevations in radians
                  "sensor: {model: custom, elevations_deg: [-0.26, -0.22, -0.19, -0.15, -0.12, "
                  "-0.08, -0.05, -0.01, 0.01, 0.05, 0.08, 0.12, 0.15, 0.19, 0.22, 0.26]}\n");
    EXPECT_THAT(run(flags).err, HasSubstr("its elevations are not in degrees"));
    fs::remove(path("scans/sensor.yaml"));
    const auto other = run(with(flags, {"-c", config("hdl64e")}));
    EXPECT_EQ(other.exit_code, 1);
    EXPECT_THAT(other.err, HasSubstr(path("scans") + ": "));
    EXPECT_THAT(other.err, HasSubstr(" % of the cloud fits HDL-64E with its 64 beams"));
    EXPECT_THAT(other.err, HasSubstr("'sensor: {model: recovered}'"));
    EXPECT_FALSE(fs::exists(path("labels")));
}

TEST_F(RawlogSegment, PrintsRepeatedRemarkOnce) {
    const auto elsewhen = folder_.write("elsewhen.tum", "0 0 0 0 0 0 0 1\n");
    const auto outcome =
        expectSuccess({"-i", recording(), "--kitti", path("out"), "--poses", elsewhen});
    EXPECT_THAT(outcome.err, HasSubstr("scan 0 (lidar): no pose near this time"));
    EXPECT_THAT(outcome.err, HasSubstr("the same for 9 more"));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 2) << outcome.err;
    const auto kitti = folder_.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
    EXPECT_THAT(expectSuccess({"-i", recording(), "-o", path("out.rawlog"), "--poses", kitti}).err,
                HasSubstr("poses.txt: ignored"));
}

TEST_F(RawlogSegment, OverwritesOwnOutputsOnly) {
    folder_.write("out.rawlog", "old");
    folder_.write("scans/velodyne/000077.bin", "old");
    folder_.write("scans/labels/made_by.txt", "old");
    const auto outcome = expectSuccess({"-q", "-i", recording(), "-o", path("out.rawlog"),
                                        "--kitti", path("scans"), "--overwrite"});
    EXPECT_EQ(outcome.out + outcome.err, "");
    EXPECT_GT(fs::file_size(path("out.rawlog")), 1000u);
    EXPECT_FALSE(fs::exists(path("scans/velodyne/000077.bin")));

    folder_.write("mine/velodyne/000000.bin", "mine");  // labelled by hand
    folder_.write("mine/labels/000000.label", "mine");
    folder_.write("work/src/main.cpp", "");
    folder_.write("notes.txt", "mine");
    fs::copy_file(recording(), path("flight.rawlog"));
    folder_.write("flight_Images/cloud_1.bin", "mine");  // MRPT stores parts of recordings here
    expectFailures({"-i", path("flight.rawlog"), "--overwrite"}, 1,
                   {{{"--kitti", path("mine")}, "mine: is not a scan folder of an earlier run"},
                    {{"--stats", path("flight_Images/cloud_1.bin")}, "flight_Images"},
                    {{"--kitti", path("work")}, "'src/main.cpp'"},
                    {{"-o", path("work")}, "not a file"},
                    {{"-o", "/dev/null"}, "not a file"},
                    {{"--kitti", path("notes.txt")}, "not a folder"},
                    {{"-o", path("flight.rawlog")}, "is or contains the input"},
                    {{"--kitti", folder_.path().string() + "/"}, "is or contains the input"}});
    expectFailures({"-i", path("scans"), "--overwrite"}, 1,
                   {{{"--kitti", path("scans")}, "is or contains the input"},
                    {{"--kitti", path("scans/velodyne")}, "is in the input"}});
    expectFailures({"-i", recording()}, 1,
                   {{{"-o", path("out.rawlog")}, "--overwrite"},
                    {{"-o", path("same"), "--kitti", path("same")}, "use separate paths"},
                    {{"-o", path("same/x"), "--kitti", path("same")}, "use separate paths"}});
}

TEST_F(RawlogSegment, PrintsHelpVersionAndSettings) {
    EXPECT_THAT(expectSuccess({"--help"}).out, HasSubstr("--kitti"));
    EXPECT_THAT(expectSuccess({"--version"}).out, HasSubstr("rawlog-segment 0."));
    const std::string keys = expectSuccess({"--config-keys"}).out;
    for (const OptionKey& key : optionKeys()) {
        EXPECT_THAT(keys, HasSubstr("\n| " + nameInFiles(key) + " ")) << key.name;
        EXPECT_THAT(keys, HasSubstr(key.what)) << key.name;
    }
    EXPECT_THAT(test::readFile(HAGEN_SOURCE_DIR "/docs/settings.md"), HasSubstr(keys))
        << "put the output of rawlog-segment --config-keys into docs/settings.md";
    const auto mine = folder_.write("mine.yaml", "beta_deg: 7.5\n");
    const std::string dump =
        expectSuccess({"--config-dump", "-c", config("paper"), "-c", mine}).out;
    EXPECT_THAT(dump, HasSubstr("beta_deg: 7.5 "));
    EXPECT_THAT(dump, HasSubstr("# [deg]"));
    EXPECT_EQ(run({"--config-dump", "-c", folder_.write("dump.yaml", dump)}).out, dump);
}

TEST_F(RawlogSegment, ConvertsScanRange) {
    const auto outcome =
        expectSuccess({"-i", recording(), "-o", path("out.rawlog"), "--cloud", "xyzi", "--from",
                       "3", "--to", "6", "-c", folder_.write("near.yaml", "zone_m: 0.1\n")});
    EXPECT_THAT(outcome.out, HasSubstr("4 LiDAR scans in 8 entries (scans 3 to 6 of the input"));
    EXPECT_THAT(outcome.out, HasSubstr("  0    0.0 %  region of interest"));
    mrpt::obs::CRawlog rawlog;
    ASSERT_TRUE(rawlog.loadFromRawLogFile(path("out.rawlog")));
    ASSERT_EQ(rawlog.size(), 16u);
    const auto roi =
        std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(rawlog.getAsObservation(2));
    EXPECT_EQ(roi->pointcloud->GetRuntimeClass()->className,
              std::string(CLASS_ID(observations::IntensityCloud)->className));
}

TEST_F(RawlogSegment, DrawsScanStages) {
    for (const char* mount : {"", "  mount_pitch_deg: 60\n", "  mount_roll_deg: 180\n"}) {
        const auto settings =
            folder_.write("settings.yaml", "sensor:\n  model: VLP-16\n" + std::string(mount));
        expectSuccess({"-i", recording(), "--pictures", path("pictures"), "--from", "1", "--to",
                       "1", "--picture-azimuth", "-90", "-c", settings, "--overwrite"});
        for (const char* name :
             {"1_depth.png", "2_maxima.png", "3_merged.png", "4_range_angle.png", "5_smoothed.png",
              "6_labels.png", "7_top_view.png", "overview.png"}) {
            EXPECT_GT(fs::file_size(folder_ / "pictures/000001" / name), 5000u) << name << mount;
        }
    }
}

TEST_F(RawlogSegment, KeepsNonFinitePointsAndEmptyScans) {
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
    const auto outcome = expectSuccess(
        {"-i", path("in.rawlog"), "-o", path("out.rawlog"), "--kitti", path("scans")});
    EXPECT_THAT(outcome.err, HasSubstr("scan 0 (empty): the scan has no packets"));
    EXPECT_THAT(outcome.out, HasSubstr("2 LiDAR scans in 2 entries, 4 returns"));
    const auto labels = recordings::readLabels(path("scans/cloud/labels/000000.label"));
    EXPECT_EQ(std::vector<std::uint16_t>(labels.begin() + 1, labels.end()),
              (std::vector<std::uint16_t>{0, 0, 0}));
}

TEST_F(RawlogSegment, RejectsInvalidArguments) {
    expectFailure({}, 2, "--input");
    expectFailure({"-o", path("out"), recording(), "more"}, 2, "not expected: more");
    const Arguments log{"-i", recording()};
    expectFailures(log, 2,
                   {{{}, "an output (-o, --view"},
                    {{"-o", ""}, "must not be empty"},
                    {{"--kitti", ""}, "must not be empty"},
                    {{"--kitti", path("out"), "--preview"}, "--output"}});
    const auto settings = [&](const std::string& name, const std::string& text) {
        return folder_.write(name, text).string();
    };
    expectFailures(with(log, {"-o", path("out")}), 2,
                   {{{"--fast"}, "--fast"},
                    {{"-i", path("none.rawlog")}, path("none.rawlog")},
                    {{"--from", "5", "--to", "4"}, "--from"},
                    {{"--from", "-1"}, "--from"},
                    {{"--pcap", path("a.pcap")}, "--pcap: excludes other outputs"},
                    {{"--jobs", "0"}, "--jobs"},
                    {{"--cloud", "rgb"}, "--cloud"},
                    {{"--picture-azimuth", "3"}, "--pictures"},
                    {{"--poses", path("none.tum")}, "none.tum"},
                    {{"-c", path("none.yaml")}, "none.yaml"},
                    {{"-c", settings("mine.yaml", "zone: 20\n")}, "'zone_m'"},
                    {{"-c", settings("beta.yaml", "beta_deg: 100\n")}, "beta_deg is 100"},
                    {{"-c", settings("window.yaml", "window_size: 20\n")}, "window_size (20)"}});
}

TEST_F(RawlogSegment, RejectsUnreadableInputs) {
    const auto fails = [&](const std::string& input, const std::string& words) {
        expectFailure({"-i", input, "-o", path("out")}, 1, words);
    };
    fails(folder_.write("a.rawlog", ""), "is empty");
    fails(folder_.write("text.rawlog", "this is no rawlog, whatever its name says\n"),
          "text.rawlog: is not a recording: it seems to be text: if it has a point per line");
    fails(folder_.write("a.rawlog", "\x89PNG\r\n\x1a\n" + std::string(99, '\x81')),
          "it seems to be a PNG picture");
    fails(folder_.write("b.rawlog", std::string(99, '\x81')), "its format is unknown");
    folder_.write("scans/velodyne/000000.bin", "123");
    fails(path("scans"), "000000.bin");
    const auto poses = folder_.write("poses.tum", "1 2 3\n");
    expectFailures({"-i", recording(), "--kitti", path("out")}, 1,
                   {{{"--poses", poses}, "poses.tum:1"},
                    {{"--sensor-label", "lidra"},
                     "no converted entry has a LiDAR scan of 'lidra'; there are 'lidar'"},
                    {{"--from", "10"}, "has 10 scans, none at or after 10"}});
}

TEST_F(RawlogSegment, ReportsUnwritableOutputs) {
    const Arguments log{"-i", recording()};
    expectFailures(log, 1,
                   {{{"-o", "/proc/self/out"}, "/proc/self/out"},
                    {{"--kitti", "/proc/self/out"}, "/proc/self/out"}});
    // A file size limit of 64 kB simulates a full disk.
    for (const Arguments& output : {Arguments{"-o", path("out.rawlog")},
                                    {"--kitti", path("scans")},
                                    {"--mcap", path("out.mcap")},
                                    {"--pictures", path("pictures"), "--to", "1"}}) {
        const auto outcome = runAfter("trap '' XFSZ; ulimit -f 64; ", with(log, output));
        EXPECT_EQ(outcome.exit_code, 1) << output[0] << outcome.err;
        EXPECT_THAT(outcome.err,
                    AnyOf(HasSubstr("cannot be written"), HasSubstr("File too large")));
        EXPECT_TRUE(fs::is_empty(folder_.path())) << output[0];
    }
    if (geteuid() == 0) GTEST_SKIP() << "root may write to the other folders";
    fs::create_directory(folder_ / "locked");
    fs::permissions(folder_ / "locked", fs::perms::owner_read | fs::perms::owner_exec);
    expectFailure({"-i", recording(), "-o", path("locked/out")}, 1, "Permission denied");
}

TEST_F(RawlogSegment, KeepsOutputOnInterrupt) {
    // Concatenated gzip files form one log, whose conversion takes much longer than the wait.
    const std::string bytes = test::readFile(recording());
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
        EXPECT_GT(test::readLog(path("out.partial.rawlog")).first, 4u);
        fs::remove(path("out.partial.rawlog"));
        EXPECT_EQ(files(), std::set<fs::path>{log});
    }
}

}  // namespace
}  // namespace hagen
