// What must cost nothing: odd surroundings of the built program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/convert/RawlogWriter.h>
#include <hagen/recordings/RawlogReader.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>
#include <sys/stat.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>
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
        recordings::RawlogReader recording(kRecording);
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
    recordings::RawlogReader recording(kRecording);
    mrpt::obs::CObservation::Ptr scan;
    while (!scan) scan = std::dynamic_pointer_cast<CObservationVelodyneScan>(recording.next());
    mrpt::obs::CSensoryFrame frame;
    const auto comment = mrpt::obs::CObservationComment::Create();
    frame.insert(comment);
    frame.insert(scan);
    convert::Bytes framed, part;
    convert::serialise(frame, framed);
    convert::serialise(*comment, part);
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
        recordings::RawlogReader(path("out.rawlog")).next());
    ASSERT_TRUE(written);
    EXPECT_EQ(written->size(), 3u);
    EXPECT_EQ(run({"-i", log, "--kitti", path("scans")}).exit_code, 0);
}

/// A log of so many scans, each with a label and a time of its own.
fs::path logOf(const test::TemporaryFolder& folder, int scans,
               const std::function<void(int, CObservationVelodyneScan&)>& change) {
    recordings::RawlogReader recording(kRecording);
    CObservationVelodyneScan::Ptr scan;
    while (!scan) scan = std::dynamic_pointer_cast<CObservationVelodyneScan>(recording.next());
    scan->scan_packets.resize(4);
    const fs::path file = folder / "in.rawlog";
    convert::RawlogWriter writer(file, true);
    for (int i = 0; i < scans; ++i) {
        change(i, *scan);
        writer.write(*scan);
    }
    writer.commit();
    return file;
}

TEST_F(RawlogSegmentTrouble, MoreSensorsThanAreReadAreNamedAndThoseBeforeAreKept) {
    const auto log = logOf(folder_, 120, [](int i, CObservationVelodyneScan& scan) {
        scan.sensorLabel = "lidar" + std::to_string(i);
    });
    const auto outcome = run({"-i", log, "-o", path("out.rawlog")});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("entry 100: the recording has more than 100 LiDARs"));
    EXPECT_TRUE(fs::exists(path("out.partial.rawlog")));
    EXPECT_EQ(run({"-i", log, "-o", path("out.rawlog"), "--sensor-label", "lidar119"}).exit_code,
              0);
}

TEST_F(RawlogSegmentTrouble, LabelsSendNothingToTheTerminal) {
    const auto log = logOf(folder_, 1, [](int, CObservationVelodyneScan& scan) {
        scan.sensorLabel = "a\x1b[2J\x07\r\x1b[Kb";
        scan.scan_packets.clear();
    });
    const auto outcome = run({"-i", log, "-o", path("out.rawlog")});
    EXPECT_THAT(outcome.err, HasSubstr("a?[2J???[Kb"));
    for (const std::string& text : {outcome.err, outcome.out}) {
        EXPECT_THAT(text, Not(HasSubstr("\x1b")));
        EXPECT_THAT(text, Not(HasSubstr("\x07")));
    }
}

/// U+009B begins a command as ESC [ does, and so does its byte on terminals with 8 bits.
TEST_F(RawlogSegmentTrouble, LabelsSendNoControlCharactersBeyondAscii) {
    const auto log = logOf(folder_, 1, [](int, CObservationVelodyneScan& scan) {
        scan.sensorLabel =
            "Ö\xc2\x9b"
            "2J\x9b"
            "2J\u65e5\u202egpj\u2066";
        scan.scan_packets.clear();
    });
    const auto outcome = run({"-i", log, "-o", path("out.rawlog")});
    EXPECT_THAT(outcome.err, HasSubstr("Ö??2J?2J\u65e5???gpj???"));
}

/// What a label says is no message of the program.
TEST_F(RawlogSegmentTrouble, LabelsBeginNoLines) {
    const auto log = logOf(folder_, 1, [](int, CObservationVelodyneScan& scan) {
        scan.sensorLabel = "a\nrawlog-segment: all is lost";
    });
    for (const std::string label : {"", "zz"}) {
        const auto outcome = run({"-i", log, "-o", path("out" + label), "--sensor-label",
                                  label.empty() ? "a\nrawlog-segment: all is lost" : label});
        EXPECT_EQ(outcome.exit_code, label.empty() ? 0 : 1);
        EXPECT_THAT(outcome.out + outcome.err, HasSubstr("a?rawlog-segment: all is lost"));
        EXPECT_THAT(outcome.out + outcome.err, Not(HasSubstr("\nrawlog-segment: all")));
    }
}

/// The name of the file by which a folder is known as one of an earlier run.
TEST_F(RawlogSegmentTrouble, ALabelThatIsTheNameOfTheMarkerCostsNothing) {
    const auto log = logOf(folder_, 4, [](int i, CObservationVelodyneScan& scan) {
        scan.sensorLabel = i % 2 == 0 ? "front" : "made_by.txt";
    });
    const auto outcome = run({"-i", log, "--clouds", path("clouds")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(fs::is_regular_file(path("clouds/made_by.txt")));
    EXPECT_TRUE(fs::is_directory(path("clouds/made_by.txt_")));
}

/// The summary of a sensor, and that of an airframe.
TEST_F(RawlogSegmentTrouble, SummariesSendNothingToTheTerminal) {
    const auto log = logOf(folder_, 12, [](int, CObservationVelodyneScan& scan) {
        scan.sensorLabel =
            "a\x1b]0;b\x07\xc2\x9b"
            "c";
    });
    const auto segmented = run({"-i", log, "-o", path("out.rawlog")});
    EXPECT_EQ(segmented.exit_code, 0) << segmented.err;
    EXPECT_THAT(segmented.out, HasSubstr("sensor a?]0;b???c: VLP-16"));
    const auto learned = run({"-i", log, "--learn-airframe", path("air.yaml"), "-c", "vlp16"});
    EXPECT_EQ(learned.exit_code, 0) << learned.err;
    EXPECT_THAT(learned.out, HasSubstr("12 LiDAR scans of 'a?]0;b???c':\n"));
}

/// To open a pipe may take forever, and a device may have no end.
TEST_F(RawlogSegmentTrouble, PipesAndDevicesAreRefusedAsAnyInput) {
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    const std::vector<std::string> flags{"-i", kRecording, "-o", path("out.rawlog")};
    for (const std::string& file : {path("pipe"), std::string("/dev/zero")}) {
        const std::string words = file + ": is a pipe or a device";
        expectFailure(with(flags, {"--octomap", path("map.bt"), "--poses", file}), 1, words);
        expectFailure(with(flags, {"-c", file}), 2, words);
        expectFailure(with(flags, {"-c", folder_.write("i.yaml", "include: " + file)}), 2, "");
    }
}

/// A file of zeros is one line of gigabytes.
TEST_F(RawlogSegmentTrouble, PosesWithoutLineBreaksAreNoText) {
    std::ofstream(path("poses.tum")).close();
    fs::resize_file(path("poses.tum"), std::uintmax_t{4} << 30);
    expectFailure({"-i", kRecording, "--octomap", path("map.bt"), "--poses", path("poses.tum")}, 1,
                  "has a line longer than 1 MiB");
}

TEST_F(RawlogSegmentTrouble, SettingsAreNotReplacedByAnOutput) {
    const std::string inner = folder_.write("inner.yaml", "beta_deg: 7\n").string();
    const std::string outer = folder_.write("outer.yaml", "include: inner.yaml\n").string();
    for (const std::string& file : {inner, outer}) {
        const std::vector<std::string> flags{"-i", kRecording, "-c", outer, "--overwrite"};
        const std::string words = "is or contains the input";
        expectFailure(with(flags, {"-o", file}), 1, words);
        expectFailure(with(flags, {"--stats", file}), 1, words);
        expectFailure(with(flags, {"--learn-airframe", file}), 1, words);
    }
    EXPECT_EQ(test::readFile(inner), "beta_deg: 7\n");
}

/// nan passes comparisons with limits, and -1 is a large unsigned number.
TEST_F(RawlogSegmentTrouble, FlagsTakeNumbersOnly) {
    const std::vector<std::string> flags{"-i", kRecording, "-o", path("out.rawlog")};
    for (const std::string wrong :
         {"--memory-limit=nan", "--memory-limit=inf", "--to=-0", "--from=99999999999999999999",
          "--jobs=2147483648", "--jobs=1.0", "--jobs=", "--memory-limit=1,5", "--to=0x10"}) {
        expectFailure(with(flags, {wrong}), 2, wrong.substr(0, wrong.find('=')));
    }
}

/// Folders that were begun are removed also where no file can be opened any more.
TEST_F(RawlogSegmentTrouble, WithoutFileDescriptorsNothingIsLeft) {
    for (int descriptors = 4; descriptors < 12; ++descriptors) {
        const std::string command = "ulimit -n " + std::to_string(descriptors) + "; ";
        const auto outcome = test::run(
            "/bin/bash", {"-c", shell(command, "-i \"" + kRecording.string() + "\" --kitti \"" +
                                                   path("k") + "\" --clouds \"" + path("c") +
                                                   "\" --mcap \"" + path("m.mcap") + "\"")});
        for (const fs::path& file : files()) EXPECT_THAT(file.string(), Not(HasSubstr("tmp-")));
        if (outcome.exit_code == 0) break;
    }
}

/// The least stack that Linux gives, and a umask that takes the owner's rights.
TEST_F(RawlogSegmentTrouble, StacksAndUmasksOfTheShellCostNothing) {
    for (const std::string odd : {"ulimit -s 64; ", "umask 777; "}) {
        const std::string arguments = "-i \"" + kRecording.string() + "\" --overwrite -o \"" +
                                      path("out.rawlog") + "\" --kitti \"" + path("k") + "\"";
        EXPECT_EQ(test::run("/bin/bash", {"-c", shell(odd, arguments)}).exit_code, 0) << odd;
    }
    EXPECT_EQ(fs::status(path("out.rawlog")).permissions(),
              fs::perms::owner_read | fs::perms::owner_write);
}

/// Instead of gnuplot: what hangs, fills the disk or leaves processes costs the pictures alone.
TEST_F(RawlogSegmentTrouble, AGnuplotThatHangsCostsThePicturesAlone) {
    for (const std::string script : {"exec sleep 1000", "sleep 1000 & wait", "kill -STOP $$",
                                     "while true; do sleep 1; done", "exec yes >&2"}) {
        const fs::path program = folder_.write("gnuplot", "#!/bin/bash\n" + script + "\n");
        fs::permissions(program, fs::perms::owner_all);
        const auto start = std::chrono::steady_clock::now();
        const auto outcome = test::run(
            "/bin/bash",
            {"-c", shell("PATH=\"" + folder_.path().string() + ":$PATH\" ",
                         "-i \"" + kRecording.string() + "\" --overwrite --to 8 -o \"" +
                             path("out.rawlog") + "\" --pictures \"" + path("p") + "\"")});
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        EXPECT_EQ(outcome.exit_code, 1) << script;
        EXPECT_THAT(outcome.err, HasSubstr("could not be written completely: gnuplot")) << script;
        EXPECT_TRUE(fs::exists(path("out.rawlog"))) << script;
        EXPECT_FALSE(fs::exists(path("p"))) << script;
        EXPECT_LT(passed.count(), 60) << script;
    }
}

/// Times at the ends of the clock, and poses at such times, are used for nothing.
TEST_F(RawlogSegmentTrouble, TimesBeyondAllClocksCostNothing) {
    const std::vector<std::int64_t> ticks{std::numeric_limits<std::int64_t>::min(),
                                          std::numeric_limits<std::int64_t>::max(), -1, 0,
                                          9'000'000'000'000'000'000};
    const auto log = logOf(folder_, 5, [&](int i, CObservationVelodyneScan& scan) {
        scan.timestamp = mrpt::Clock::time_point(mrpt::Clock::duration(ticks[i]));
    });
    const auto outcome =
        run({"-i", log, "-o", path("out.rawlog"), "--mcap", path("out.mcap"), "--kitti",
             path("scans"), "--stats", path("out.json"), "--poses",
             folder_.write("still.tum", "0 0 0 0 0 0 0 1\n90000000000 0 0 0 0 0 0 1\n")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    recordings::RawlogReader reader(path("out.rawlog"));
    for (int i = 0; i < 5; ++i) {
        const auto scan = std::dynamic_pointer_cast<CObservationVelodyneScan>(reader.next());
        ASSERT_TRUE(scan);
        EXPECT_EQ(scan->timestamp.time_since_epoch().count(), ticks[i]);
        reader.next();
        reader.next();
    }
    EXPECT_THAT(test::readFile(path("scans") + "/times.txt"), Not(HasSubstr("nan")));
    for (const char* const line : {"9e18 0 0 0 0 0 0 1\n", "-1e300 0 0 0 0 0 0 1\n"}) {
        expectFailure(
            {"-i", log, "-o", path("again.rawlog"), "--poses", folder_.write("bad.tum", line)}, 1,
            "bad.tum:1: the first number is no time");
    }
}

TEST_F(RawlogSegmentTrouble, IncludesOfARecordingsSettingsAreLimited) {
    fs::create_directories(folder_ / "scans/velodyne");
    const std::vector<float> points(4 * 100, 5.0f);
    std::ofstream(folder_ / "scans/velodyne/000000.bin", std::ios::binary)
        .write(reinterpret_cast<const char*>(points.data()), 4 * 400);
    std::string seven;  // 9 of 9 of 9 ... files
    for (int i = 0; i < 9; ++i) seven += "- next.yaml\n";
    folder_.write("scans/next.yaml", "include:\n" + seven);
    folder_.write("scans/sensor.yaml", "include: [next.yaml]\n");
    const std::vector<std::string> flags{"-i", (folder_ / "scans").string(), "--kitti",
                                         path("out")};
    expectFailure(flags, 2, "nested too deeply");
    std::string flat;
    for (int i = 0; i < 40; ++i) flat += "- empty.yaml\n";
    folder_.write("scans/empty.yaml", "");
    folder_.write("scans/sensor.yaml", "include:\n" + flat);
    expectFailure(flags, 2, "include more than 32 files");
    folder_.write("secret.yaml", "");
    for (const std::string& elsewhere : {std::string("../secret.yaml"), path("secret.yaml")}) {
        folder_.write("scans/sensor.yaml", "include: " + elsewhere + "\n");
        expectFailure(flags, 2, "only files of their own folder");
        folder_.write("scans/sensor.yaml", "airframe:\n  - learned: " + elsewhere + "\n");
        expectFailure(flags, 2, "only files of their own folder");
    }
    folder_.write("scans/sensor.yaml", "# " + std::string(1 << 20, 'x'));
    expectFailure(flags, 2, "larger than 1 MiB");
}

/// Threads that the system refuses, for whatever reason: here, memory for their stacks.
TEST_F(RawlogSegmentTrouble, ThreadsThatCannotBeStartedAreDoneWithout) {
    const std::string convert =
        "-i \"" + kRecording.string() + "\" --jobs 64 -o \"" + path("out.rawlog") + "\"";
    for (const int mb : {900, 600}) {
        const auto outcome = test::run(
            "/bin/bash", {"-c", shell("ulimit -v " + std::to_string(mb * 1024) + "; ", convert)});
        EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 1)
            << mb << ": " << outcome.exit_code << outcome.err;
        for (const fs::path& file : files()) EXPECT_THAT(file.string(), Not(HasSubstr("tmp-")));
        fs::remove(path("out.rawlog"));
    }
}

TEST_F(RawlogSegmentTrouble, MoreMemoryThanAllowedIsNamed) {
    const auto outcome =
        run({"-i", kRecording, "-o", path("out.rawlog"), "--memory-limit", "0.06", "--octomap",
             path("map.bt"), "--octomap-resolution", "0.03", "--poses", still(scansOfRecording())});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("out of memory (--memory-limit: 0.06 GB)"));
    expectFailure({"-i", kRecording, "-o", path("other.rawlog"), "--memory-limit", "0"}, 2,
                  "--memory-limit");
}

/// As Ctrl-C in a terminal does, the signal goes to the program and to all of its children.
TEST_F(RawlogSegmentTrouble, AnInterruptionWhilePicturesAreDrawnKeepsTheRawlog) {
    const std::string command = "set -m; \"" + std::string(HAGEN_RAWLOG_SEGMENT) + "\" -i \"" +
                                kRecording.string() + "\" --pictures \"" + path("pictures") +
                                "\" -o \"" + path("out.rawlog") +
                                "\" & sleep 1; kill -INT -- -$!; wait $!";
    const auto outcome = test::run("/bin/bash", {"-c", command});
    if (outcome.exit_code == 0) GTEST_SKIP() << "the pictures were drawn within a second";
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("interrupted; the "));
    EXPECT_TRUE(fs::exists(path("out.partial.rawlog"))) << outcome.err;
}

/// A scan folder whose first scan cannot be opened, but is not asked for.
TEST_F(RawlogSegmentTrouble, AScanThatIsSkippedMayBeMissing) {
    ASSERT_EQ(run({"-i", kRecording, "--kitti", path("scans")}).exit_code, 0);
    fs::remove(path("scans/velodyne/000000.bin"));
    fs::create_symlink("nowhere", path("scans/velodyne/000000.bin"));
    const auto outcome =
        run({"-i", path("scans"), "--from", "1", "--to", "4", "-o", path("out.rawlog")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(path("out.rawlog")));
    // Asked for, it costs what comes after it: nothing is before it.
    const auto all = run({"-i", path("scans"), "-o", path("all.rawlog")});
    EXPECT_EQ(all.exit_code, 1);
    EXPECT_THAT(all.err, HasSubstr("000000.bin"));
}

/// As on a disk that is unplugged: what was converted before is kept.
TEST_F(RawlogSegmentTrouble, ScansThatVanishMeanwhileKeepThoseBefore) {
    ASSERT_EQ(run({"-i", kRecording, "--kitti", path("scans")}).exit_code, 0);
    fs::remove(path("scans/velodyne/000005.bin"));
    fs::create_symlink("nowhere", path("scans/velodyne/000005.bin"));
    fs::remove(path("scans/poses.txt"));
    const auto outcome = run({"-i", path("scans"), "-o", path("out.rawlog")});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("000005.bin"));
    EXPECT_THAT(outcome.err, HasSubstr("the 5 scans before it are in"));
    EXPECT_TRUE(fs::exists(path("out.partial.rawlog"))) << outcome.err;
}

/// A laser of a scan's own calibration that points nowhere.
TEST_F(RawlogSegmentTrouble, ACorruptCalibrationCostsItsScan) {
    recordings::RawlogReader recording(kRecording);
    convert::RawlogWriter writer(path("in.rawlog"), false);
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

/// One bad sample of an estimator.
TEST_F(RawlogSegmentTrouble, APoseThatIsNotFiniteIsToldAndUsedForNothing) {
    recordings::RawlogReader recording(kRecording);
    convert::RawlogWriter writer(path("in.rawlog"), false);
    int scans = 0;
    while (const auto entry = recording.next()) {
        const auto scan = std::dynamic_pointer_cast<CObservationVelodyneScan>(entry);
        if (scan) {
            mrpt::obs::CObservationRobotPose pose;
            pose.sensorLabel = "pose";
            pose.timestamp = scan->timestamp;
            pose.pose.mean = {scans == 2 ? std::nan("") : 0.1, 0, 0, 0, 0, 0};
            writer.write(pose);
            ++scans;
        }
        writer.write(*entry);
    }
    writer.commit();
    const auto outcome = run({"-i", path("in.rawlog"), "--to", "9", "--kitti", path("scans")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("poses that are not finite are left out: 1"));
    EXPECT_THAT(test::readFile(path("scans/poses.tum")), Not(HasSubstr("nan")));
    EXPECT_EQ(run({"-i", path("scans"), "--kitti", path("again")}).exit_code, 0);
}

}  // namespace
}  // namespace hagen
