// What must cost nothing: odd surroundings of the built program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/logs/RawlogReader.h>
#include <hagen/logs/RawlogWriter.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>
#include <sys/stat.h>

#include <cmath>
#include <map>

#include "support/ProgramTest.h"

namespace hagen {
namespace {

using mrpt::obs::CObservationVelodyneScan;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;
const fs::path kRecording = fs::path(HAGEN_SOURCE_DIR) / "rawlogs/poles_and_wall.rawlog";

class RawlogSegmentTrouble : public test::ProgramTest {
 protected:
    test::Outcome run(const std::vector<std::string>& arguments) const override {
        return test::run(HAGEN_RAWLOG_SEGMENT, arguments);
    }
    /// Poses (KITTI) of a sensor that stays where it is, for this many scans.
    fs::path still(int scans) const {
        std::string lines;
        for (int i = 0; i < scans; ++i) lines += "1 0 0 0 0 1 0 0 0 0 1 1\n";
        return folder_.write("still.txt", lines);
    }
    static int scansOfRecording() {
        int scans = 0;
        logs::RawlogReader recording(kRecording);
        while (const auto entry = recording.next()) {
            scans += std::dynamic_pointer_cast<CObservationVelodyneScan>(entry) != nullptr;
        }
        return scans;
    }
};

/// A closed stream's number would be that of the next file: messages would go into the output.
TEST_F(RawlogSegmentTrouble, ClosedStreamsDoNotEndUpInTheOutput) {
    const std::vector<std::string> flags{"-i", kRecording, "-o", path("open.rawlog"), "--preview"};
    ASSERT_EQ(run(flags).exit_code, 0);
    for (const std::string closed : {">&- 2>&-", "<&- >&- 2>&-", "2>&-", "<&-"}) {
        const std::string command = std::string("\"") + HAGEN_RAWLOG_SEGMENT + "\" -i \"" +
                                    kRecording.string() + "\" --preview --overwrite -o \"" +
                                    path("closed.rawlog") + "\" " + closed;
        EXPECT_EQ(test::run("/bin/sh", {"-c", command}).exit_code, 0) << closed;
        EXPECT_TRUE(test::readFile(path("closed.rawlog")) == test::readFile(path("open.rawlog")))
            << closed;
    }
}

TEST_F(RawlogSegmentTrouble, APipeIsRefusedAtOnce) {
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    expectFailure({"-i", path("pipe"), "-o", path("out.rawlog")}, 1, "is a pipe or a device");
    expectFailure({"-i", "/dev/zero", "-o", path("out.rawlog")}, 1, "is a pipe or a device");
}

std::string shell(const std::string& before, const std::string& arguments) {
    return before + "exec \"" + HAGEN_RAWLOG_SEGMENT + "\" " + arguments;
}

/// A full disk, or a file that may not grow further, costs the output that meets it alone.
TEST_F(RawlogSegmentTrouble, AnOutputThatCannotBeWrittenCostsNoOther) {
    const std::string flight = "-i \"" + (fs::path(HAGEN_SOURCE_DIR) / "rawlogs").string() +
                               "/poles_and_wall.rawlog\" --octomap-resolution 0.1 --poses \"" +
                               still(scansOfRecording()).string() + "\" ";
    const std::vector<std::string> names{"out.rawlog", "map.bt", "map.3Dscene", "out.json"};
    const std::string outputs = "-o \"" + path(names[0]) + "\" --octomap \"" + path(names[1]) +
                                "\" --octomap \"" + path(names[2]) + "\" --stats \"" +
                                path(names[3]) + "\"";
    ASSERT_EQ(test::run("/bin/bash", {"-c", shell("", flight + outputs)}).exit_code, 0);
    std::map<std::uintmax_t, std::string> by_size;
    for (const std::string& name : names) {
        by_size[fs::file_size(path(name))] = name;
        fs::remove(path(name));
    }
    const auto largest = by_size.rbegin();
    const std::uintmax_t limit_kib = std::next(largest)->first / 1024 + 1;
    ASSERT_LT(limit_kib * 1024, largest->first);
    const auto outcome = test::run(
        "/bin/bash", {"-c", shell("trap '' XFSZ; ulimit -f " + std::to_string(limit_kib) + "; ",
                                  flight + outputs)});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr(path(largest->second)));
    EXPECT_FALSE(fs::exists(path(largest->second))) << outcome.err;
    for (const std::string& name : names) {
        EXPECT_EQ(fs::exists(path(name)), name != largest->second) << name << outcome.err;
    }
    for (const fs::path& file : files()) EXPECT_THAT(file.string(), Not(HasSubstr("tmp-")));
}

TEST_F(RawlogSegmentTrouble, ASceneOnAFullDiskIsAnError) {
    const std::string arguments = "-i \"" + kRecording.string() + "\" --octomap \"" +
                                  path("map.3Dscene") + "\" --poses \"" +
                                  still(scansOfRecording()).string() + "\"";
    ASSERT_EQ(test::run("/bin/bash", {"-c", shell("", arguments)}).exit_code, 0);
    const auto size_kib = fs::file_size(path("map.3Dscene")) / 1024;
    fs::remove(path("map.3Dscene"));
    for (const auto limit_kib : {std::uintmax_t{2}, size_kib / 2, size_kib}) {
        const auto outcome = test::run(
            "/bin/bash", {"-c", shell("trap '' XFSZ; ulimit -f " + std::to_string(limit_kib) + "; ",
                                      arguments)});
        EXPECT_EQ(outcome.exit_code, 1) << limit_kib;
        EXPECT_THAT(outcome.err, HasSubstr("cannot be written")) << limit_kib;
        EXPECT_EQ(files().size(), 1u) << limit_kib;  // the poses
    }
}

TEST_F(RawlogSegmentTrouble, VoxelsThatAreTooSmallAreRefusedAtOnce) {
    expectFailure({"-i", kRecording, "--octomap", path("map.bt"), "--octomap-resolution", "0.01"},
                  1, "use voxels of at least 0.0");
}

/// MRPT reads null objects in sensory frames, and cannot write them.
TEST_F(RawlogSegmentTrouble, ANullObjectInASensoryFrameIsLeftOutAndTold) {
    logs::RawlogReader recording(kRecording);
    mrpt::obs::CObservation::Ptr scan;
    while (!scan) scan = std::dynamic_pointer_cast<CObservationVelodyneScan>(recording.next());
    mrpt::obs::CSensoryFrame frame;
    const auto comment = mrpt::obs::CObservationComment::Create();
    frame.insert(comment);
    frame.insert(scan);
    logs::Bytes framed, part;
    logs::serialise(frame, framed);
    logs::serialise(*comment, part);
    mrpt::io::CMemoryStream null;
    mrpt::serialization::archiveFrom(null).WriteObject(nullptr);
    std::string bytes(framed.begin(), framed.end());
    const std::size_t at = bytes.find(std::string(part.begin(), part.end()));
    ASSERT_NE(at, std::string::npos);
    bytes.replace(at, part.size(), static_cast<const char*>(null.getRawBufferData()),
                  null.getTotalBytesCount());
    const std::string log = folder_.write("in.rawlog", bytes);
    const auto outcome = run({"-i", log, "-o", path("out.rawlog"), "--cloud", "generic",
                              "--octomap", path("map.bt"), "--poses", still(1)});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("have 1 null objects"));
    const auto written = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(
        logs::RawlogReader(path("out.rawlog")).next());
    ASSERT_TRUE(written);
    EXPECT_EQ(written->size(), 3u);
    EXPECT_EQ(run({"-i", log, "--kitti", path("scans")}).exit_code, 0);
}

/// A laser of a scan's own calibration that points nowhere.
TEST_F(RawlogSegmentTrouble, ACorruptCalibrationCostsItsScan) {
    logs::RawlogReader recording(kRecording);
    logs::RawlogWriter writer(path("in.rawlog"), false);
    int scans = 0;
    while (const auto entry = recording.next()) {
        const auto scan = std::dynamic_pointer_cast<CObservationVelodyneScan>(entry);
        if (scan && scans++ == 0) {
            scan->calibration = mrpt::obs::VelodyneCalibration::LoadDefaultCalibration("VLP16");
            scan->calibration.laser_corrections.at(3).cosVertCorrection = std::nan("");
        }
        writer.write(*entry);
    }
    writer.commit();
    const auto outcome = run({"-i", path("in.rawlog"), "-o", path("out.rawlog"), "--octomap",
                              path("map.bt"), "--poses", still(scansOfRecording())});
    EXPECT_EQ(outcome.exit_code, scans > 1 ? 0 : 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("calibration is corrupt: laser 3"));
}

}  // namespace
}  // namespace hagen
