// rawlog-segment on point cloud files, as a user would run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/recordings/CloudFile.h>
#include <hagen/recordings/ScanFolder.h>
#include <hagen/scan/Angle.h>
#include <hagen/scan/Scan.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "support/CloudFiles.h"
#include "support/ProgramTest.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

/// Files of one scan, which test/support lays out byte by byte.
struct Written {
    std::string ending;
    std::function<std::string(const Scan&)> text;
};

std::string records(const Scan& scan, bool is_big_endian) {
    test::Packed packed;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        for (const float number : {scan.x_m[i], scan.y_m[i], scan.z_m[i], scan.intensity[i]}) {
            is_big_endian ? packed.addBig(number) : packed.add(number);
        }
    }
    return packed.text;
}

std::string plyOf(const Scan& scan, bool is_big_endian) {
    return std::string("ply\nformat binary_") + (is_big_endian ? "big" : "little") +
           "_endian 1.0\nelement vertex " + std::to_string(scan.size()) +
           "\nproperty float x\nproperty float y\nproperty float z\nproperty float intensity\n"
           "end_header\n" +
           records(scan, is_big_endian);
}

std::string pcdOf(const Scan& scan) {
    return "VERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
           "WIDTH " +
           std::to_string(scan.size()) + "\nHEIGHT 1\nPOINTS " + std::to_string(scan.size()) +
           "\nDATA binary\n" + records(scan, false);
}

std::string npyOf(const Scan& scan) {
    return test::npy("{'descr': '<f4', 'fortran_order': False, 'shape': (" +
                         std::to_string(scan.size()) + ", 4), }",
                     records(scan, false));
}

const std::vector<Written>& formats() {
    static const std::vector<Written> kFormats{
        {".pcd", pcdOf},
        {".ply", [](const Scan& scan) { return plyOf(scan, false); }},
        {".ply", [](const Scan& scan) { return plyOf(scan, true); }},
        {".npy", npyOf},
        {".bin", [](const Scan& scan) { return records(scan, false); }}};
    return kFormats;
}

class RawlogSegmentClouds : public test::ProgramTest {
 protected:
    test::Outcome run(const std::vector<std::string>& arguments) const override {
        return test::run(HAGEN_RAWLOG_SEGMENT, arguments);
    }
    static std::string config(const std::string& name) {
        return std::string(HAGEN_SOURCE_DIR) + "/config/" + name + ".yaml";
    }
    /// Poles on the ground, as a VLP-16 sees them.
    static Scan poles() {
        test::SimpleScene scene;
        scene.poles = {{6, 1, 0.2, 4}, {-4, 3, 0.3, 3}};
        Scan scan = scanScene(scene, sensorModel("VLP-16"), 900, {0, 0, 1.5}).scan;
        scan.intensity.assign(scan.size(), 0.5f);
        return scan;
    }
    std::string write(const std::string& name, const std::string& text) const {
        fs::create_directories(fs::path(path(name)).parent_path());
        test::writeFile(path(name), text);
        return path(name);
    }
    /// The labels in a folder of labelled clouds, one file after the other.
    std::vector<double> labelsOf(const std::string& folder) const {
        std::set<fs::path> files;
        for (const auto& file : fs::directory_iterator(path(folder))) {
            if (recordings::hasCloudName(file.path())) files.insert(file.path());
        }
        std::vector<double> labels;
        for (const fs::path& file : files) {
            const auto table = recordings::readCloud(file).table;
            const auto more = columnOf(table, *findField(table, {"label"}));
            labels.insert(labels.end(), more.begin(), more.end());
        }
        return labels;
    }
    std::vector<double> labelsOfScanFolder(const fs::path& folder) const {
        const recordings::ScanFolder scans(folder);
        std::vector<double> labels;
        for (std::size_t i = 0; i < scans.size(); ++i) {
            const auto more = recordings::readLabels(scans.labelFile(i));
            labels.insert(labels.end(), more.begin(), more.end());
        }
        return labels;
    }
};

TEST_F(RawlogSegmentClouds, EveryFormatGivesTheLabelsOfTheScanFolder) {
    const Scan scan = poles();
    fs::create_directories(path("scans") + "/velodyne");
    recordings::writeScan(path("scans") + "/velodyne/000000.bin", scan);
    for (const std::vector<std::string>& settings :
         {std::vector<std::string>{}, {"-c", config("vlp16")}}) {
        fs::remove_all(path("kitti"));
        ASSERT_EQ(run(with(settings, {"-i", path("scans"), "--kitti", path("kitti")})).exit_code,
                  0);
        const auto expected = labelsOfScanFolder(path("kitti"));
        ASSERT_GT(std::count(expected.begin(), expected.end(), 2.0), 100);
        ASSERT_GT(std::count(expected.begin(), expected.end(), 1.0), 100);
        for (const Written& format : formats()) {
            const std::string file = write("000000" + format.ending, format.text(scan));
            const auto outcome =
                run(with(settings, {"-i", file, "--clouds", path("out"), "--overwrite"}));
            ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
            EXPECT_EQ(labelsOf("out"), expected) << format.ending;
            EXPECT_THAT(outcome.out,
                        AllOf(HasSubstr("labelled clouds: " + path("out") + " ("),
                              HasSubstr(", 1 file, " + std::to_string(scan.size()) + " points)")));
        }
    }
}

TEST_F(RawlogSegmentClouds, EveryFormatGivesTheLabelsOfRealScanFolders) {
    const fs::path data = test::dataFolder("HAGEN_LABELLED_DATA");
    if (data.empty()) GTEST_SKIP() << "HAGEN_LABELLED_DATA names no folder of scans";
    const recordings::ScanFolder scans(data / "beams16" / "00");
    // The folder names its beams; files of clouds are told so.
    const std::vector<std::string> settings{"-q", "-c", config("vlp16"), "-c",
                                            scans.sensorFile().string()};
    ASSERT_EQ(
        run(with(settings, {"-i", scans.path().string(), "--kitti", path("kitti"), "--to", "1"}))
            .exit_code,
        0);
    const auto expected = labelsOfScanFolder(path("kitti"));
    for (const Written& format : formats()) {
        fs::remove_all(path("in"));
        for (std::size_t i = 0; i < 2; ++i) {
            Scan scan;
            recordings::readScan(scans.scanFile(i), scan);
            write("in/" + scans.name(i) + format.ending, format.text(scan));
        }
        const auto outcome = run(with(settings, {"-i", path("in"), "--clouds", path("out"),
                                                 "--cloud-format", "pcd", "--overwrite"}));
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(labelsOf("out"), expected) << format.ending;
    }
}

TEST_F(RawlogSegmentClouds, ASensorIsRecoveredAndRemarksAreTold) {
    const std::string file = write("a.npy", npyOf(poles()));
    const auto outcome = run({"-i", file, "-o", path("out.rawlog"), "--stats", path("out.json")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("sensor lidar: "));
    EXPECT_THAT(outcome.out, HasSubstr("beams recovered"));
    EXPECT_THAT(outcome.err, HasSubstr("0.1 s apart"));
    EXPECT_THAT(outcome.err,
                HasSubstr("does not hold (--cloud generic and --clouds do): intensity"));
}

TEST_F(RawlogSegmentClouds, LabelledCloudsAreInputsAgain) {
    write("in/1.pcd", pcdOf(poles()));
    ASSERT_EQ(run({"-q", "-i", path("in"), "--clouds", path("a")}).exit_code, 0);
    const auto outcome = run({"-i", path("a"), "--clouds", path("b"), "--cloud-format", "pcd",
                              "--stats", path("b.json")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(path("b") + "/1.pcd"));
    EXPECT_EQ(labelsOf("a"), labelsOf("b"));
    EXPECT_THAT(outcome.err, HasSubstr("'input_obstacle'"));
    const auto stats = nlohmann::json::parse(test::readFile(path("b.json")));
    EXPECT_EQ(stats["clouds"]["files"], 1);
    EXPECT_EQ(stats["clouds"]["points"], labelsOf("b").size());
    EXPECT_EQ(stats["outputs"]["clouds"], path("b"));
}

TEST_F(RawlogSegmentClouds, TheSameBytesForAnyNumberOfThreads) {
    for (const char* const name : {"in/1.pcd", "in/2.pcd", "in/3.pcd"}) write(name, pcdOf(poles()));
    for (const std::string jobs : {"1", "3"}) {
        ASSERT_EQ(
            run({"-q", "-i", path("in"), "--clouds", path("out" + jobs), "--jobs", jobs}).exit_code,
            0);
    }
    for (const char* const name : {"/1.ply", "/2.ply", "/3.ply"}) {
        EXPECT_EQ(test::readFile(path("out1") + name), test::readFile(path("out3") + name));
    }
}

TEST_F(RawlogSegmentClouds, FieldsOfMrpt3ReachTheLabelledClouds) {
    const fs::path data = test::dataFolder("HAGEN_MRPT3_DATA");
    if (data.empty()) GTEST_SKIP() << "HAGEN_MRPT3_DATA names no folder of logs of MRPT 3";
    const std::string log = (data / "sample_mrpt3.rawlog").string();
    ASSERT_EQ(run({"-q", "-i", log, "--clouds", path("out")}).exit_code, 0);
    const auto table = recordings::readCloud(path("out") + "/cloud/000000.ply").table;
    EXPECT_EQ(namesOf(table), "x, y, z, intensity, t, ring, label, obstacle");
    // Its rings are a VLP-16's laser numbers, which do not rise with the elevation.
    const auto column = [&](const char* name) {
        return columnOf(table, *findField(table, {name}));
    };
    const auto x_m = column("x"), y_m = column("y"), z_m = column("z"), rings = column("ring");
    for (std::size_t i = 0; i < table.points; ++i) {
        const int laser = static_cast<int>(rings[i]);
        const double elevation_deg = degrees(std::atan2(z_m[i], std::hypot(x_m[i], y_m[i])));
        ASSERT_NEAR(elevation_deg, laser % 2 == 0 ? laser - 15 : laser, 0.1);
    }
    const auto again = run({"-i", path("out") + "/cloud", "--clouds", path("again")});
    EXPECT_THAT(again.out, HasSubstr("its ring numbers do not agree with elevations"));
}

// Failures

TEST_F(RawlogSegmentClouds, BrokenFilesFailNamingFileAndPlace) {
    const auto fails = [&](const std::string& name, const std::string& text,
                           const std::string& words) {
        const std::string file = write(name, text);
        expectFailure({"-i", file, "--clouds", path("out")}, 1, file + ": " + words);
    };
    const auto points = test::filePoints();
    fails("a.pcd", "", "is empty");
    fails("a.pcd", test::binaryPcd(points).substr(0, 300), "the header says 12 points");
    fails("a.pcd", "VERSION 0.7\nFIELDS x\nSIZE 4\nTYPE F\nWIDTH 1\nDATA zip\n",
          "line 6: DATA 'zip'");
    fails("a.ply", test::asciiPly(points).substr(0, 400), "the header says 12 'vertex'");
    fails("a.ply", test::binaryPly(points, true).substr(0, 60), "line 4: 'element' is no line");
    fails("a.las", test::las(points).substr(0, 300), "the header says 12 points");
    fails("a.laz", test::las(points).replace(104, 1, "\x81"), "is compressed (LAZ)");
    fails("a.npy", test::structuredNpy(points).substr(0, 200), "the header says 12 points");
    fails("a.bin", test::bin(points) + "x", "193 bytes are not a multiple");
    fails("a.bin", "A text of 32 bytes is no cloud.\n", "is no point cloud: it seems to be text");
    fails("picture.pcd", "\xff\xd8\xff\xe0" + std::string(900, '\x81'),
          "is no point cloud: it seems to be a JPEG picture");
}

TEST_F(RawlogSegmentClouds, ABreakInAFolderKeepsWhatWasBefore) {
    write("in/1.pcd", pcdOf(poles()));
    write("in/2.pcd", pcdOf(poles()).substr(0, 1000));
    write("in/3.pcd", pcdOf(poles()));
    const auto outcome = run({"-i", path("in"), "--clouds", path("out")});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("2.pcd: the header says"));
    EXPECT_THAT(outcome.err, HasSubstr("out.partial"));
    EXPECT_TRUE(fs::exists(path("out.partial") + "/1.ply"));
    EXPECT_FALSE(fs::exists(path("out")));
}

TEST_F(RawlogSegmentClouds, WrongUsageIsToldFromFailure) {
    const std::string file = write("a.pcd", pcdOf(poles()));
    expectFailure({"-i", file, "--clouds", path("out"), "--cloud-format", "las"}, 2, "las");
    expectFailure({"-i", file, "--kitti", path("out"), "--cloud-format", "pcd"}, 2, "--clouds");
    expectFailure({"-i", file, "--clouds", ""}, 2, "must not be empty");
    expectFailure({"-i", file, "--clouds", path("none") + "/out"}, 1, "none");
    fs::create_directory(path("taken"));
    expectFailure({"-i", file, "--clouds", path("taken")}, 1, "taken exists");
    fs::create_directory(path("notes"));
    write("notes/notes.txt", "mine");
    expectFailure({"-i", file, "--clouds", path("notes"), "--overwrite"}, 1, "'made_by.txt'");
    // Clouds of the user, which have the same names as labelled ones.
    fs::create_directory(path("mine"));
    fs::copy_file(file, path("mine/000000.pcd"));
    expectFailure({"-i", file, "--clouds", path("mine"), "--overwrite"}, 1, "has no 'made_by.txt'");
    EXPECT_TRUE(fs::exists(path("mine/000000.pcd")));
    expectFailure({"-i", file, "--clouds", folder_.path().string(), "--overwrite"}, 1,
                  "is or contains the input");
    expectFailure({"-i", path("notes"), "--clouds", path("out")}, 1,
                  "notes: not a scan folder (no subfolder 'velodyne' with .bin files), and no "
                  "folder of point "
                  "clouds");
}

}  // namespace
}  // namespace hagen
