// rawlog-simulate, including its packets compared with the simulation.
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/mrpt/Trajectory.h>
#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/recordings/RawlogReader.h>
#include <hagen/recordings/ScanFolder.h>
#include <hagen/scan/Angle.h>
#include <hagen/settings/Settings.h>
#include <hagen/simulation/Scenarios.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include "recordings/PoseFile.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include <hagen/convert/SimulatedObservation.h>
#include "support/ProgramTest.h"

namespace hagen {
namespace {

using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;
using mrpt::obs::CObservationRobotPose;
using mrpt::obs::CObservationVelodyneScan;

const fs::path kOrchardLog = fs::path(HAGEN_SOURCE_DIR) / "rawlogs/orchard.rawlog";
constexpr double kRoi = 443232, kRou = 185797;  // ground-truth labels

struct LogContent {
    std::vector<CObservationVelodyneScan::Ptr> scans;
    std::vector<CObservationRobotPose::Ptr> poses;
};
LogContent readLog(const fs::path& file) {
    LogContent content;
    recordings::RawlogReader reader(file);
    while (const auto entry = reader.next()) {
        if (auto scan = std::dynamic_pointer_cast<CObservationVelodyneScan>(entry)) {
            content.scans.push_back(scan);
        } else if (auto pose = std::dynamic_pointer_cast<CObservationRobotPose>(entry)) {
            content.poses.push_back(pose);
        }
    }
    return content;
}

std::vector<double> readNumbers(const fs::path& file) {
    std::ifstream in(file);
    return {std::istream_iterator<double>(in), {}};
}

class RawlogSimulate : public test::ProgramTest {
 protected:
    test::Outcome run(const Arguments& arguments) const override {
        return test::run(HAGEN_RAWLOG_SIMULATE, arguments);
    }

    const std::vector<std::string> wires_{"--scenario", "wires", "--scans", "3",
                                          "--altitude", "4",     "--seed",  "2",
                                          "--every-s",  "0.5"};
};

TEST_F(RawlogSimulate, WritesSameReturnsToLogAndFolder) {
    const auto outcome = expectSuccess(
        with(wires_, {"-o", path("a.rawlog"), "--kitti", path("a"), "--poses", path("a.tum")}));
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out, HasSubstr("3 scans of wires"));

    const LogContent log = readLog(path("a.rawlog"));
    const recordings::ScanFolder folder(path("a"));
    ASSERT_EQ(log.scans.size(), 3u);
    ASSERT_EQ(folder.size(), 3u);
    std::set<int> kinds;
    for (std::size_t n = 0; n < 3; ++n) {
        Scan decoded, read;
        observations::decodePackets(*log.scans[n], decoded);
        recordings::readScan(folder.scanFile(n), read);
        EXPECT_EQ(decoded.x_m, read.x_m);
        EXPECT_EQ(decoded.y_m, read.y_m);
        EXPECT_EQ(decoded.z_m, read.z_m);
        const auto labels = recordings::readLabels(folder.labelFile(n));
        const auto semantic =
            recordings::readLabels(folder_ / ("a/semantic/" + folder.name(n) + ".label"));
        ASSERT_EQ(labels.size(), read.size());
        ASSERT_EQ(semantic.size(), read.size());
        for (std::size_t i = 0; i < labels.size(); ++i) {
            ASSERT_EQ(labels[i], static_cast<int>(simulation::labelOf(
                                     static_cast<simulation::ObjectClass>(semantic[i]))));
            kinds.insert(semantic[i]);
        }
    }
    for (const simulation::ObjectClass kind :
         {simulation::ObjectClass::Terrain, simulation::ObjectClass::Canopy,
          simulation::ObjectClass::Tree, simulation::ObjectClass::Pole,
          simulation::ObjectClass::Wire, simulation::ObjectClass::Airframe}) {
        EXPECT_EQ(kinds.count(static_cast<int>(kind)), 1u) << simulation::nameOf(kind);
    }
    const std::vector<double> times_s = folder.times();
    ASSERT_EQ(times_s.size(), 3u);
    for (std::size_t n = 0; n < 3; ++n) {
        EXPECT_NEAR(times_s[n], mrpt::Clock::toDouble(log.scans[n]->timestamp), 1e-3) << n;
        EXPECT_NEAR(times_s[n] - times_s[0], 0.5 * static_cast<double>(n), 1e-6) << n;
    }
    const std::vector<double> altitudes_m = readNumbers(folder_ / "a/altitudes.txt");
    ASSERT_EQ(altitudes_m.size(), 3u);
    for (const double altitude_m : altitudes_m) EXPECT_NEAR(altitude_m, 4, 1);
    EXPECT_THAT(test::readFile(folder_ / "a/kinds.yaml"), HasSubstr("5: {name: wire, label: 2}"));
    EXPECT_THAT(test::readFile(folder_ / "a/kinds.yaml"), HasSubstr("2: {name: canopy, label: 1}"));
    EXPECT_EQ(recordings::readTumPoses(folder.tumFile()).size(), 3u);
    EXPECT_EQ(recordings::readTumPoses(path("a.tum")).size(), log.poses.size());
}

TEST_F(RawlogSimulate, PosesCoverWholeScans) {
    expectSuccess(with(wires_, {"-o", path("a.rawlog")}));
    const LogContent log = readLog(path("a.rawlog"));
    observations::Trajectory trajectory;
    for (const auto& pose : log.poses) trajectory.add(pose->timestamp, pose->pose.mean);
    EXPECT_EQ(trajectory.size(), log.poses.size());  // no duplicates
    for (const auto& scan : log.scans) {
        for (const double since_s : {0.0, 0.03, 0.1001}) {
            const auto time =
                mrpt::Clock::fromDouble(mrpt::Clock::toDouble(scan->timestamp) + since_s);
            EXPECT_TRUE(trajectory.at(time).has_value()) << since_s;
        }
    }
}

TEST_F(RawlogSimulate, WritesSensorWithoutPacketsToFolder) {
    ASSERT_EQ(run({"--scenario", "street", "--scans", "1", "--altitude", "2", "--seed", "1",
                   "--sensor", "HDL-64E", "--kitti", path("a"), "-q"})
                  .out,
              "");
    Scan scan;
    recordings::readScan(recordings::ScanFolder(path("a")).scanFile(0), scan);
    EXPECT_GT(scan.size(), 50000u);
}

TEST_F(RawlogSimulate, StoresSensorMount) {
    expectSuccess(with(wires_, {"--poses", path("upright.tum")}));
    expectSuccess(with(wires_, {"--mount-roll-deg", "180", "--mount-pitch-deg", "-20", "-o",
                                path("a.rawlog"), "--kitti", path("a"), "--poses", path("a.tum")}));
    EXPECT_EQ(test::readFile(path("a.tum")), test::readFile(path("upright.tum")));

    const mrpt::poses::CPose3D mount(0, 0, 0, 0, radians(-20), radians(180));
    const auto expectSame = [](const mrpt::poses::CPose3D& a, const mrpt::poses::CPose3D& b) {
        EXPECT_LT((a.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>() -
                   b.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>())
                      .maxCoeff(),
                  1e-6);
    };
    const LogContent log = readLog(path("a.rawlog"));
    observations::Trajectory vehicle;
    for (const auto& pose : log.poses) vehicle.add(pose->timestamp, pose->pose.mean);
    const auto sensor_poses = recordings::readTumPoses(recordings::ScanFolder(path("a")).tumFile());
    ASSERT_EQ(sensor_poses.size(), log.scans.size());
    for (std::size_t n = 0; n < log.scans.size(); ++n) {
        expectSame(log.scans[n]->sensorPose, mount);
        expectSame(sensor_poses[n].pose, *vehicle.at(log.scans[n]->timestamp) + mount);
    }
    Settings settings;
    mergeSettings(recordings::ScanFolder(path("a")).sensorFile(), settings);
    EXPECT_FLOAT_EQ(settings.mount.roll_rad, static_cast<float>(kPi));
    EXPECT_FLOAT_EQ(settings.mount.pitch_rad, static_cast<float>(radians(-20)));
    EXPECT_EQ(settings.sensorModel().rows(), 16);
}

TEST_F(RawlogSimulate, WritesMid360AsClouds) {
    expectSuccess({"--scenario", "forest-0.05", "--scans", "3", "--altitude", "2", "--seed", "3",
                   "--sensor", "Mid-360", "-o", path("a.rawlog"), "--kitti", path("a"),
                   "--mount-roll-deg", "180"});
    const recordings::ScanFolder folder(path("a"));
    ASSERT_EQ(folder.size(), 3u);
    Settings settings;
    mergeSettings(folder.sensorFile(), settings);
    EXPECT_FALSE(settings.sensorModel().has_rings);

    recordings::RawlogReader reader(path("a.rawlog"));
    std::size_t entries = 0, scans = 0;
    while (const auto entry = reader.next()) {
        ++entries;
        const auto cloud = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(entry);
        if (!cloud) continue;
        EXPECT_EQ(cloud->sensorLabel, "lidar");
        EXPECT_NEAR(std::abs(cloud->sensorPose.roll()), kPi, 1e-9);
        observations::ObservedScan observed;
        observations::readObservation(*cloud, settings, observed);
        Scan stored;
        recordings::readScan(folder.scanFile(scans), stored);
        EXPECT_GT(stored.size(), 10000u);
        EXPECT_EQ(observed.scan.x_m, stored.x_m);
        EXPECT_EQ(observed.scan.z_m, stored.z_m);
        EXPECT_EQ(observed.scan.intensity, stored.intensity);
        EXPECT_EQ(recordings::readLabels(folder.labelFile(scans)).size(), stored.size());
        ++scans;
    }
    ASSERT_EQ(scans, 3u);

    const std::string preset = HAGEN_SOURCE_DIR "/config/mid360.yaml";
    const auto segmented = test::run(
        HAGEN_RAWLOG_SEGMENT, {"-i", path("a.rawlog"), "-c", preset, "-o", path("b.rawlog")});
    ASSERT_EQ(segmented.exit_code, 0) << segmented.err;
    EXPECT_EQ(segmented.err, "");
    recordings::RawlogReader result(path("b.rawlog"));
    std::size_t written = 0;
    while (result.next()) ++written;
    EXPECT_EQ(written, entries + 2 * scans);
}

TEST_F(RawlogSimulate, ClearAirHasNoUnclassifiedReturns) {
    const Arguments flags = with(wires_, {"-o", path("a.rawlog"), "--kitti", path("a")});
    EXPECT_THAT(expectSuccess(flags).out, Not(HasSubstr(" 0 unclassified")));
    EXPECT_THAT(expectSuccess(with(flags, {"--clear-air", "--overwrite"})).out,
                HasSubstr(" 0 unclassified"));
}

/// The exact command is in rawlogs/README.md. If sines differ in the last bit between machines, a
/// return and later random numbers may differ, so returns are compared with a tolerance.
TEST_F(RawlogSimulate, ReproducesDemoRecording) {
    const std::string command =
        "rawlog-simulate --scenario orchard --scans 30 --every-s 0.2 "
        "--altitude 2 --seed 1 -o rawlogs/orchard.rawlog";
    ASSERT_THAT(test::readFile(HAGEN_SOURCE_DIR "/rawlogs/README.md"), HasSubstr(command));
    const auto outcome = run({"--scenario", "orchard", "--scans", "30", "--every-s", "0.2",
                              "--altitude", "2", "--seed", "1", "-o", path("orchard.rawlog")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const LogContent kept = readLog(kOrchardLog), made = readLog(path("orchard.rawlog"));
    ASSERT_EQ(kept.scans.size(), 30u);
    ASSERT_EQ(made.scans.size(), 30u);
    EXPECT_EQ(made.poses.size(), kept.poses.size());
    double kept_returns = 0, made_returns = 0;
    for (std::size_t n = 0; n < 30; ++n) {
        EXPECT_EQ(made.scans[n]->timestamp, kept.scans[n]->timestamp);
        Scan kept_scan, made_scan;
        observations::decodePackets(*kept.scans[n], kept_scan);
        observations::decodePackets(*made.scans[n], made_scan);
        kept_returns += static_cast<double>(kept_scan.size());
        made_returns += static_cast<double>(made_scan.size());
    }
    EXPECT_NEAR(made_returns, kept_returns, 0.002 * kept_returns);

    std::istringstream words(outcome.out);  // "30 scans of orchard with N returns: N RoI, N ROU"
    std::string word;
    double scans = 0, returns = 0, roi = 0, rou = 0;
    words >> scans >> word >> word >> word >> word >> returns >> word >> roi >> word >> rou;
    EXPECT_EQ(returns, made_returns);
    EXPECT_NEAR(roi, kRoi, 0.002 * kRoi);
    EXPECT_NEAR(rou, kRou, 0.002 * kRou);
}

TEST_F(RawlogSimulate, RejectsInvalidArguments) {
    expectFailure({"--scenario", "jungle", "--scans", "1", "--altitude", "2", "--seed", "1", "-o",
                   path("a.rawlog")},
                  2, "unknown scenario 'jungle'; known: orchard, field, forest-0.02");
    const Arguments orchard{"--scenario", "orchard", "--seed", "1", "-o", path("a.rawlog")};
    expectFailures(orchard, 2,
                   {{{"--scans", "0", "--altitude", "2"}, "--scans"},
                    {{"--scans", "1", "--altitude", "0.19"}, "--altitude"},
                    {{"--scans", "1", "--altitude", "15.1"}, "--altitude"},
                    {{"--altitude", "2"}, "--scans is required"}});
    const Arguments one = with(orchard, {"--scans", "1", "--altitude", "2"});
    for (const std::string flag : {"--speed-m-s", "--tilt-sd-deg", "--every-s", "--mount-roll-deg",
                                   "--mount-pitch-deg", "--altitude", "--scans", "--seed"}) {
        expectFailure(with(one, {flag + "=nan"}), 2, flag);
    }
    for (const std::string wrong :
         {"--seed=-1", "--mount-pitch-deg=-91", "--mount-roll-deg=181", "--mount-roll-deg=down",
          "--tilt-sd-deg=16", "--every-s=0.05", "--sensor=VLP-99"}) {
        expectFailure(with(one, {wrong}), 2, wrong.substr(0, wrong.find('=')));
    }
    expectFailures(wires_, 2,
                   {{{}, "an output (-o, --kitti, --poses or --pcap)"},
                    {{"--sensor", "HDL-64E", "-o", path("a.rawlog")}, "HDL-64E"},
                    {{"--sensor", "Mid-360", "--pcap", path("a.pcap")}, "Mid-360"}});
}

TEST_F(RawlogSimulate, KeepsExistingFiles) {
    folder_.write("a.rawlog", "mine");
    folder_.write("work/thesis.txt", "mine");
    expectFailures(
        wires_, 1,
        {{{"-o", path("a.rawlog"), "--kitti", path("a")}, "a.rawlog exists; use --overwrite"},
         {{"--kitti", path("work"), "--overwrite"}, "thesis.txt"},
         {{"-o", "/dev/full", "--overwrite"}, "/dev/full"}});
    EXPECT_EQ(test::readFile(path("a.rawlog")), "mine");
}

TEST_F(RawlogSimulate, KeepsOutputOnInterrupt) {
    const auto outcome =
        test::run("/usr/bin/timeout",
                  {"--preserve-status", "-s", "INT", "2", HAGEN_RAWLOG_SIMULATE, "--scenario",
                   "gap", "--scans", "100000", "--altitude", "2", "--seed", "1", "-o",
                   path("a.rawlog"), "--kitti", path("a"), "--poses", path("a.tum")});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("interrupted; the "));
    EXPECT_FALSE(fs::exists(path("a.rawlog")) || fs::exists(path("a")) ||
                 fs::exists(path("a.tum")));
    const LogContent log = readLog(path("a.partial.rawlog"));
    EXPECT_GT(log.scans.size(), 1u);
    EXPECT_EQ(recordings::ScanFolder(path("a.partial")).times().size(), log.scans.size());
    EXPECT_EQ(recordings::readTumPoses(path("a.partial.tum")).size(), log.poses.size());
}

class EachPacketSensor : public testing::TestWithParam<const char*> {};

TEST_P(EachPacketSensor, PacketsMatchSimulatedReturns) {
    const SensorModel sensor = sensorModel(GetParam());
    const simulation::Scene scene = simulation::makeScene("wires", 3);
    const simulation::Flight flight(scene.terrain(), scene.path(), {}, 3);
    simulation::Random random(3);
    const simulation::SimulatedScan made =
        simulation::simulateScan(scene, sensor, flight, 1.0, random);
    Scan decoded;
    ASSERT_EQ(
        observations::decodePackets(*convert::encodeSimulatedScan(made, sensor, 1.0), decoded), 0u);
    ASSERT_EQ(decoded.size(), made.size());
    for (std::size_t i = 0; i < made.size(); ++i) {
        ASSERT_NEAR(decoded.range_m[i], made.scan.range_m[i], 0.0011f) << i;
        ASSERT_EQ(decoded.row[i], made.scan.row[i]) << i;
        ASSERT_NEAR(decoded.time_s[i], made.scan.time_s[i], 2e-6f) << i;
        const double azimuth_rad = std::remainder(
            static_cast<double>(decoded.azimuth_rad[i] - made.scan.azimuth_rad[i]), 2 * kPi);
        ASSERT_NEAR(azimuth_rad, 0, 5e-4) << i;
        ASSERT_NEAR(decoded.z_m[i], made.scan.z_m[i], 0.002f + 1e-4f * made.scan.range_m[i]) << i;
    }
}

INSTANTIATE_TEST_SUITE_P(All, EachPacketSensor, testing::Values("VLP-16", "HDL-32E"),
                         [](const auto& sensor) { return std::string(sensor.param).erase(3, 1); });

}  // namespace
}  // namespace hagen
