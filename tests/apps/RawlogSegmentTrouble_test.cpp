// rawlog-segment with corrupt recordings, full disks, scarce resources and interruptions.
#include <hagen/recordings/RawlogReader.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>
#include <sys/stat.h>
#include "convert/RawlogWriter.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <map>

#include "support/SegmentTest.h"

namespace hagen {
namespace {

using mrpt::obs::CObservationVelodyneScan;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;
using Change = std::function<void(int, CObservationVelodyneScan&)>;

class RawlogSegmentTrouble : public test::SegmentTest {
 protected:
    /// KITTI poses of a static sensor.
    std::string still(int scans = 10) const {
        std::string lines;
        for (int i = 0; i < scans; ++i) lines += "1 0 0 0 0 1 0 0 0 0 1 1\n";
        return folder_.write("still.txt", lines);
    }
    /// A log of small scans modified by `change`.
    std::string logOf(int scans, const Change& change) const {
        recordings::RawlogReader reader(recording());
        CObservationVelodyneScan::Ptr scan;
        while (!scan) scan = std::dynamic_pointer_cast<CObservationVelodyneScan>(reader.next());
        scan->scan_packets.resize(4);
        convert::RawlogWriter writer(path("in.rawlog"), true);
        for (int i = 0; i < scans; ++i) {
            change(i, *scan);
            writer.write(*scan);
        }
        writer.commit();
        return path("in.rawlog");
    }
};

/// Opening a pipe may block, and a device may be endless.
TEST_F(RawlogSegmentTrouble, RejectsPipesAndDevices) {
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    for (const std::string& file : {path("pipe"), std::string("/dev/zero")}) {
        const std::string words = file + ": is a pipe or a device";
        expectFailure({"-i", file, "-o", path("out.rawlog")}, 1, "is a pipe or a device");
        const Arguments flags{"-i", recording(), "-o", path("out.rawlog")};
        expectFailure(with(flags, {"--octomap", path("map.bt"), "--poses", file}), 1, words);
        expectFailure(with(flags, {"-c", file}), 2, words);
        expectFailure(with(flags, {"-c", folder_.write("i.yaml", "include: " + file)}), 2, "");
    }
}

/// A file size limit affects only the largest output.
TEST_F(RawlogSegmentTrouble, UnwritableOutputDoesNotAffectOthers) {
    const std::vector<std::string> names{"out.rawlog", "map.bt", "map.3Dscene", "out.json"};
    const Arguments flags{"-i",           recording(),    "--octomap-resolution",
                          "0.1",          "--poses",      still(),
                          "-o",           path(names[0]), "--octomap",
                          path(names[1]), "--octomap",    path(names[2]),
                          "--stats",      path(names[3])};
    expectSuccess(flags);
    std::map<std::uintmax_t, std::string> by_size;
    for (const std::string& name : names) {
        by_size[fs::file_size(path(name))] = name;
        fs::remove(path(name));
    }
    const auto largest = by_size.rbegin();
    const std::uintmax_t limit_kib = std::next(largest)->first / 1024 + 1;
    ASSERT_LT(limit_kib * 1024, largest->first);
    const auto outcome =
        runAfter("trap '' XFSZ; ulimit -f " + std::to_string(limit_kib) + "; ", flags);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr(path(largest->second)));
    for (const std::string& name : names) {
        EXPECT_EQ(fs::exists(path(name)), name != largest->second) << name << outcome.err;
    }
    expectNoTemporaryFiles();
}

/// MRPT reads null objects in sensory frames, but cannot write them.
TEST_F(RawlogSegmentTrouble, OmitsNullObjectsInSensoryFrames) {
    recordings::RawlogReader reader(recording());
    mrpt::obs::CObservation::Ptr scan;
    while (!scan) scan = std::dynamic_pointer_cast<CObservationVelodyneScan>(reader.next());
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
    const auto outcome = expectSuccess({"-i", log, "-o", path("out.rawlog"), "--cloud", "generic",
                                        "--octomap", path("map.bt"), "--poses", still(1)});
    EXPECT_THAT(outcome.err, HasSubstr("dropped 1 null object from sensory frames"));
    const auto written = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(
        recordings::RawlogReader(path("out.rawlog")).next());
    ASSERT_TRUE(written);
    EXPECT_EQ(written->size(), 3u);
    expectSuccess({"-i", log, "--kitti", path("scans")});
}

TEST_F(RawlogSegmentTrouble, LimitsNumberOfSensors) {
    const auto log = logOf(120, [](int i, CObservationVelodyneScan& scan) {
        scan.sensorLabel = "lidar" + std::to_string(i);
    });
    const auto outcome = run({"-i", log, "-o", path("out.rawlog")});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("scan 100: the recording has more than 100 LiDAR labels"));
    EXPECT_TRUE(fs::exists(path("out.partial.rawlog")));
    expectSuccess({"-i", log, "-o", path("out.rawlog"), "--sensor-label", "lidar119"});
}

/// Like ESC [, U+009B starts a control sequence, as does byte 0x9b on 8-bit terminals.
TEST_F(RawlogSegmentTrouble, ReplacesControlCharactersInLabels) {
    const std::string line = "rawlog-segment: all is lost";
    const std::string label =
        "a\x1b[2J\x07\r\n" + line + "Ö\xc2\x9b" + "2J\x9b" + "2J\u65e5\u202egpj\u2066";
    const std::string safe = "a?[2J???" + line + "Ö??2J?2J\u65e5???gpj???";
    const auto log = logOf(12, [&](int i, CObservationVelodyneScan& scan) {
        scan.sensorLabel = label;
        if (i == 11) scan.scan_packets.clear();  // causes a remark
    });
    const auto segmented = expectSuccess({"-i", log, "-o", path("out.rawlog")});
    EXPECT_THAT(segmented.out, HasSubstr("sensor " + safe + ": "));
    EXPECT_THAT(segmented.err, HasSubstr("(" + safe + "): the scan has no packets"));
    const auto wrong = run({"-i", log, "-o", path("none"), "--sensor-label", "zz"});
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_THAT(wrong.err, HasSubstr(safe));
    const auto learned =
        expectSuccess({"-i", log, "--learn-airframe", path("air.yaml"), "-c", "vlp16"});
    EXPECT_THAT(learned.out, HasSubstr("LiDAR scans of '" + safe + "':\n"));
}

TEST_F(RawlogSegmentTrouble, AcceptsLabelNamedLikeMarkerFile) {
    const auto log = logOf(4, [](int i, CObservationVelodyneScan& scan) {
        scan.sensorLabel = i % 2 == 0 ? "front" : "made_by.txt";
    });
    expectSuccess({"-i", log, "--clouds", path("clouds")});
    EXPECT_TRUE(fs::is_regular_file(path("clouds/made_by.txt")));
    EXPECT_TRUE(fs::is_directory(path("clouds/made_by.txt_")));
}

TEST_F(RawlogSegmentTrouble, OutputsDoNotReplaceSettings) {
    const std::string inner = folder_.write("inner.yaml", "beta_deg: 7\n").string();
    const std::string outer = folder_.write("outer.yaml", "include: inner.yaml\n").string();
    for (const std::string& file : {inner, outer}) {
        for (const std::string flag : {"--kitti", "--stats", "--learn-airframe"}) {
            expectFailure({"-i", recording(), "-c", outer, "--overwrite", flag, file}, 1,
                          "is or contains the input");
        }
    }
    EXPECT_EQ(test::readFile(inner), "beta_deg: 7\n");
}

/// CLI11 would accept nan and convert -1 to a large unsigned number.
TEST_F(RawlogSegmentTrouble, FlagsAcceptNumbersOnly) {
    for (const std::string wrong :
         {"--memory-limit=nan", "--memory-limit=inf", "--to=-0", "--from=99999999999999999999",
          "--jobs=2147483648", "--jobs=1.0", "--jobs=", "--memory-limit=1,5", "--to=0x10"}) {
        expectFailure({"-i", recording(), "-o", path("out.rawlog"), wrong}, 2,
                      wrong.substr(0, wrong.find('=')));
    }
}

TEST_F(RawlogSegmentTrouble, MissingDescriptorsDoNotDamageOutput) {
    // With fewer than 5 descriptors, the program's libraries do not load.
    for (int descriptors = 6; descriptors < 12; descriptors += 2) {
        const auto outcome = runAfter("ulimit -n " + std::to_string(descriptors) + "; ",
                                      {"-i", recording(), "--kitti", path("k"), "--mcap",
                                       path("m.mcap"), "--to", "1", "--overwrite"});
        const bool is_complete = outcome.exit_code == 0;
        EXPECT_TRUE(is_complete || outcome.exit_code == 1) << outcome.exit_code << outcome.err;
        if (is_complete) {
            EXPECT_TRUE(fs::exists(path("k/labels/000001.label")) && fs::exists(path("m.mcap")));
        } else if (fs::exists(path("k"))) {
            EXPECT_TRUE(fs::exists(path("k/labels/000001.label"))) << outcome.err;
        }
    }
}

/// A Python that is missing, fails, lacks matplotlib, hangs, or leaves child processes behind.
TEST_F(RawlogSegmentTrouble, FailedPythonAffectsPicturesOnly) {
    const std::string package = "apt-get install python3-matplotlib";
    for (const auto& [script, message] : {std::pair<std::string, std::string>{"", package},
                                          {"exit 3", "python3 ended without drawing"},
                                          {"echo '" + package + "'", package},
                                          {"sleep 1000 & wait", "python3 hangs"}}) {
        if (!script.empty()) {
            fs::permissions(folder_.write("python3", "#!/bin/bash\n" + script + "\n"),
                            fs::perms::owner_all);
        }
        const std::string more = script.empty() ? "" : ":$PATH";
        const auto outcome = runAfter("export PATH=\"" + folder_.path().string() + more + "\"; ",
                                      {"-i", recording(), "--to", "2", "-o", path("out.rawlog"),
                                       "--pictures", path("p"), "--overwrite"});
        EXPECT_EQ(outcome.exit_code, 1) << script;
        EXPECT_THAT(outcome.err, HasSubstr(message)) << script;
        EXPECT_TRUE(fs::exists(path("out.rawlog"))) << script;
        EXPECT_FALSE(fs::exists(path("p"))) << script;
    }
}

/// Times at the limits of the clock, with poses at these times.
TEST_F(RawlogSegmentTrouble, IgnoresImplausibleTimes) {
    const std::vector<std::int64_t> ticks{std::numeric_limits<std::int64_t>::min(),
                                          std::numeric_limits<std::int64_t>::max(), -1, 0,
                                          9'000'000'000'000'000'000};
    const auto log = logOf(5, [&](int i, CObservationVelodyneScan& scan) {
        scan.timestamp = mrpt::Clock::time_point(mrpt::Clock::duration(ticks[i]));
    });
    expectSuccess({"-i", log, "-o", path("out.rawlog"), "--mcap", path("out.mcap"), "--kitti",
                   path("scans"), "--stats", path("out.json"), "--poses",
                   folder_.write("still.tum", "0 0 0 0 0 0 0 1\n90000000000 0 0 0 0 0 0 1\n")});
    recordings::RawlogReader reader(path("out.rawlog"));
    for (const std::int64_t due : ticks) {
        const auto scan = std::dynamic_pointer_cast<CObservationVelodyneScan>(reader.next());
        ASSERT_TRUE(scan);
        EXPECT_EQ(scan->timestamp.time_since_epoch().count(), due);
        reader.next();
        reader.next();
    }
    EXPECT_THAT(test::readFile(path("scans/times.txt")), Not(HasSubstr("nan")));
    for (const char* const line : {"9e18 0 0 0 0 0 0 1\n", "-1e300 0 0 0 0 0 0 1\n"}) {
        expectFailure(
            {"-i", log, "-o", path("again.rawlog"), "--poses", folder_.write("bad.tum", line)}, 1,
            "bad.tum:1: the first number is not a time");
    }
}

TEST_F(RawlogSegmentTrouble, LimitsIncludesInRecordedSettings) {
    fs::create_directories(folder_ / "scans/velodyne");
    folder_.write("scans/velodyne/000000.bin", std::string(1600, '\x40'));
    folder_.write("secret.yaml", "");
    folder_.write("scans/empty.yaml", "");
    std::string nested = "include:\n", flat = "include:\n";
    for (int i = 0; i < 9; ++i) nested += "- next.yaml\n";
    for (int i = 0; i < 40; ++i) flat += "- empty.yaml\n";
    folder_.write("scans/next.yaml", nested);
    const std::vector<std::pair<std::string, std::string>> cases{
        {"include: [next.yaml]\n", "nested too deeply"},
        {flat, "include more than 32 files"},
        {"include: ../secret.yaml\n", "only files of their own folder"},
        {"airframe:\n  - learned: " + path("secret.yaml") + "\n",
         "only to files in their own folder"},
        {"# " + std::string(1 << 20, 'x'), "larger than 1 MiB"}};
    for (const auto& [text, words] : cases) {
        folder_.write("scans/sensor.yaml", text);
        expectFailure({"-i", path("scans"), "--kitti", path("out")}, 2, words);
    }
}

/// Stacks of 4 GB in 24 GB of addresses; each process keeps enough for the heap.
TEST_F(RawlogSegmentTrouble, MissingThreadsDoNotDamageOutput) {
    const auto outcome =
        runAfter("ulimit -s 4194304; ulimit -v 25165824; ",
                 {"-i", recording(), "--jobs", "64", "-o", path("out.rawlog"), "--overwrite"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("of 64 threads"));
    expectNoTemporaryFiles();
}

TEST_F(RawlogSegmentTrouble, ReportsMemoryLimit) {
    const auto outcome =
        run({"-i", recording(), "-o", path("out.rawlog"), "--memory-limit", "0.06", "--octomap",
             path("map.bt"), "--octomap-resolution", "0.03", "--poses", still()});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("out of memory (--memory-limit: 0.06 GB)"));
    expectFailure({"-i", recording(), "-o", path("other.rawlog"), "--memory-limit", "0"}, 2,
                  "--memory-limit");
}

}  // namespace
}  // namespace hagen
