// rawlog-segment on point cloud files.
#include <hagen/recordings/ScanFolder.h>
#include <hagen/scan/Scan.h>
#include "recordings/clouds/CloudFile.h"

#include <algorithm>

#include "support/CloudFiles.h"
#include "support/SegmentTest.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

using testing::AllOf;
using testing::HasSubstr;

namespace fs = std::filesystem;

/// A cloud file: its format and contents.
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

class RawlogSegmentClouds : public test::SegmentTest {
 protected:
    /// Poles on the ground, as a VLP-16 sees them.
    static Scan poles() {
        const test::SimpleScene scene = test::sceneOf({}, {{6, 1, 0.2, 4}, {-4, 3, 0.3, 3}});
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
    std::vector<double> labelled(const std::string& folder) const {
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

TEST_F(RawlogSegmentClouds, EveryFormatGetsSameLabels) {
    const Scan scan = poles();
    fs::create_directories(path("scans") + "/velodyne");
    recordings::writeScan(path("scans") + "/velodyne/000000.bin", scan);
    for (const std::vector<std::string>& settings :
         {std::vector<std::string>{}, {"-c", config("vlp16")}}) {
        expectSuccess(
            with(settings, {"-i", path("scans"), "--kitti", path("kitti"), "--overwrite"}));
        const auto expected = labelsOfScanFolder(path("kitti"));
        ASSERT_GT(std::count(expected.begin(), expected.end(), 2.0), 100);
        ASSERT_GT(std::count(expected.begin(), expected.end(), 1.0), 100);
        for (const Written& format : formats()) {
            const std::string file = write("000000" + format.ending, format.text(scan));
            const auto outcome =
                expectSuccess(with(settings, {"-i", file, "--clouds", path("out"), "--overwrite"}));
            EXPECT_EQ(labelled("out"), expected) << format.ending;
            EXPECT_THAT(outcome.out,
                        AllOf(HasSubstr("labelled clouds: " + path("out") + " ("),
                              HasSubstr(", 1 file, " + std::to_string(scan.size()) + " points)")));
        }
    }
}

TEST_F(RawlogSegmentClouds, RecoversSensorAndPrintsRemarks) {
    const std::string file = write("a.npy", npyOf(poles()));
    const auto outcome = expectSuccess({"-i", file, "-o", path("out.rawlog")});
    EXPECT_THAT(outcome.out, HasSubstr("sensor lidar: "));
    EXPECT_THAT(outcome.out, HasSubstr("beams recovered"));
    EXPECT_THAT(outcome.err, HasSubstr("assuming 0.1 s"));
    EXPECT_THAT(outcome.err,
                HasSubstr("cannot store (--cloud generic and --clouds can): intensity"));
}

TEST_F(RawlogSegmentClouds, ReadsOwnOutput) {
    write("in/1.pcd", pcdOf(poles()));
    expectSuccess({"-q", "-i", path("in"), "--clouds", path("a")});
    const auto outcome = expectSuccess({"-i", path("a"), "--clouds", path("b"), "--cloud-format",
                                        "pcd", "--stats", path("b.json")});
    EXPECT_TRUE(fs::exists(path("b") + "/1.pcd"));
    EXPECT_EQ(labelled("a"), labelled("b"));
    EXPECT_THAT(outcome.err, HasSubstr("'input_obstacle'"));
    const auto stats = readJson("b.json");
    EXPECT_EQ(stats["clouds"]["files"], 1);
    EXPECT_EQ(stats["clouds"]["points"], labelled("b").size());
    EXPECT_EQ(stats["outputs"]["clouds"], path("b"));
}

TEST_F(RawlogSegmentClouds, ReadsStatedBinFields) {
    test::Packed packed;
    const Scan scan = poles();
    for (std::size_t i = 0; i < scan.size(); ++i) {
        for (const float number : {scan.x_m[i], scan.y_m[i], scan.z_m[i]}) packed.add(number);
    }
    const std::string file = write("a.bin", packed.text);
    write("folder/velodyne/a.bin", packed.text);
    for (const std::string& input : {file, path("folder")}) {
        expectFailure({"-i", input, "--kitti", path("out"), "--overwrite"}, 1,
                      "fit 4 numbers per point, but 3; state their meaning: rawlog-segment "
                      "--bin-fields x,y,z ");
        EXPECT_THAT(
            run({"-i", input, "--kitti", path("out"), "--overwrite", "--bin-fields", "x,y,z"}).out,
            HasSubstr(std::to_string(scan.size()) + " returns"));
    }
    expectFailure({"-i", file, "--kitti", path("new"), "--bin-fields", "x,y"}, 2,
                  "--bin-fields: the field z is missing");
    expectFailure({"-i", write("a.pcap", std::string("\xd4\xc3\xb2\xa1")), "--kitti", path("new"),
                   "--bin-fields", "x,y,z"},
                  1, "--bin-fields does not apply");
}

TEST_F(RawlogSegmentClouds, RejectsInvalidOutputs) {
    const std::string file = write("in/a.pcd", pcdOf(poles()));
    fs::create_directory(path("taken"));
    write("notes/notes.txt", "mine");
    write("mine/000000.pcd", "mine");  // a user's file, named like a labelled cloud
    expectFailures({"-i", file}, 2,
                   {{{"--clouds", path("out"), "--cloud-format", "las"}, "las"},
                    {{"--kitti", path("out"), "--cloud-format", "pcd"}, "--clouds"},
                    {{"--clouds", ""}, "must not be empty"}});
    expectFailures({"-i", file}, 1,
                   {{{"--clouds", "/proc/self/out"}, "/proc/self/out"},
                    {{"--clouds", path("taken")}, "taken exists"},
                    {{"--clouds", path("notes"), "--overwrite"}, "'made_by.txt'"},
                    {{"--clouds", path("mine"), "--overwrite"}, "has no 'made_by.txt'"},
                    {{"--clouds", path("in"), "--overwrite"}, "is or contains the input"}});
    expectFailure(
        {"-i", path("notes"), "--clouds", path("out")}, 1,
        "notes: not a scan folder (no subfolder 'velodyne' with .bin files), not a folder "
        "of point clouds");
}

}  // namespace
}  // namespace hagen
