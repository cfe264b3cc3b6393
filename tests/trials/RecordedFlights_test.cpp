// Some short flights must repeat the recorded ones exactly, unless kRevision was counted up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/trials/Calibration.h>
#include <hagen/trials/RunTable.h>
#include <hagen/trials/SettingsHash.h>
#include <hagen/trials/Trial.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/Program.h"

namespace hagen::trials {
namespace {

using testing::HasSubstr;

const char kFile[] = HAGEN_SOURCE_DIR "/tests/trials/recorded_flights.csv";
const char kHowToRecord[] =
    "count up kRevision in libs/trials/include/hagen/trials/SettingsHash.h, and record again: "
    "HAGEN_RECORD_FLIGHTS=1 scripts/test -R RecordedFlights";

/// The recorded flights: "revision,N", then rows as in runs.csv. A flight may have several: it
/// comes out as one of them, and which one depends on the machine (docs/octomap-compare.md).
struct Recording {
    int revision;
    std::string rows;
};

std::string textOf(const Recording& recording) {
    return "revision," + std::to_string(recording.revision) + "\n" + recording.rows;
}

Recording recordingFrom(const std::string& text) {
    Recording recording{0, ""};
    std::istringstream in(text);
    std::string word;
    std::getline(in, word, ',');
    in >> recording.revision;
    in.ignore();
    std::getline(in, recording.rows, '\0');
    return recording;
}

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// What is wrong with a recording, given the flights of this revision; empty: nothing.
std::string faultOf(const Recording& recording, const Recording& flown) {
    if (recording.revision != flown.revision) {
        return "recorded at revision " + std::to_string(recording.revision) +
               ", but kRevision is " + std::to_string(flown.revision) +
               "; if it was counted up, record again: HAGEN_RECORD_FLIGHTS=1 scripts/test -R "
               "RecordedFlights";
    }
    const std::vector<std::string> recorded_rows = linesOf(recording.rows);
    const std::set<std::string> recorded(recorded_rows.begin(), recorded_rows.end());
    const std::vector<std::string> rows = linesOf(flown.rows);
    const bool are_known = std::all_of(
        rows.begin(), rows.end(), [&](const std::string& row) { return recorded.count(row) > 0; });
    if (are_known) return "";
    return std::string("flights differ from the recorded ones; if the change is intended, ") +
           kHowToRecord;
}

/// Why these flights may not replace the recorded ones; empty: they may.
std::string obstacleTo(const Recording& flown, const Recording& recorded) {
    if (flown.revision > recorded.revision || textOf(flown) == textOf(recorded)) return "";
    return std::string("flights or kRevision changed, but kRevision was not counted up; first ") +
           kHowToRecord;
}

/// Latencies that do not depend on the profile that comes with the program.
LatencyProfile someProfile() {
    LatencyProfile profile = constantProfile(1);
    for (auto& [stage, quantiles_ms] : profile.quantiles_ms) quantiles_ms = {2, 5, 8, 40};
    return profile;
}

/// Every scenario, air, guidance, planner, pose error and kind of model at least once. Fast
/// flights, because they are short.
std::vector<std::string> keys() {
    return {"forest-0.02,1,W-RoI,straight,10,primitives,none,1,optimistic,dusty,unbiased",
            "forest-0.05,2,O-RoI-0.4,straight,10,3dvfh,noise,1,optimistic,dusty,unbiased",
            "forest-0.10,3,W-RoI,astar,10,3dvfh,none,1,optimistic,dusty,unbiased",
            "orchard,4,W-Full,astar,10,primitives,drift,1,optimistic,dusty,unbiased",
            "gap,5,O-Full-0.4,astar,8,primitives,none,1,optimistic,dusty,unbiased",
            "u-trap,6,oracle,astar,10,primitives,none,1,optimistic,dusty,unbiased",
            "terrain,7,W-RoI,straight,10,primitives,none,1,optimistic,dusty,unbiased",
            "wires,8,O-RoI+rays-0.4,straight,10,primitives,none,1,brake_known,dusty,unbiased",
            "movers,9,W-RoI,astar,10,primitives,noise,4,optimistic,dusty,unbiased",
            "street,10,G-Full,straight,10,3dvfh,none,1,optimistic,dusty,unbiased",
            "forest-0.02,1,W-RoI,straight,10,primitives,none,1,optimistic,clear,as-stored"};
}

Recording fly() {
    const LatencyProfile profile = someProfile();
    Recording flown{kRevision, runHeader() + "\n"};
    for (const std::string& key : keys()) {
        hagen::trials::Run run = runOfKey(key);
        const Course course = makeCourse(run.scenario, run.seed);
        run.oracle_path_m = course.oracle_path_m;
        run.result = runTrial(course, run.setup, profile);
        flown.rows += rowOf(run) + "\n";
    }
    return flown;
}

TEST(RecordedFlights, ComeOutAsRecordedAtThisRevision) {
    const Recording recorded = recordingFrom(test::readFile(kFile)), flown = fly();
    if (std::getenv("HAGEN_RECORD_FLIGHTS") != nullptr) {
        ASSERT_EQ(obstacleTo(flown, recorded), "");
        std::ofstream(kFile, std::ios::binary) << textOf(flown);
        return;
    }
    EXPECT_EQ(faultOf(recorded, flown), "") << "recorded:\n"
                                            << recorded.rows << "flown:\n"
                                            << flown.rows;
}

TEST(RecordedFlights, AChangeWithoutANewRevisionIsFoundAndCannotBeRecorded) {
    const Recording recorded{3, "a\n"}, changed{3, "b\n"};
    EXPECT_THAT(faultOf(recorded, changed), HasSubstr("count up kRevision"));
    EXPECT_THAT(obstacleTo(changed, recorded), HasSubstr("count up kRevision"));
    EXPECT_EQ(faultOf({3, "a\nb\nc\n"}, {3, "a\nc\n"}), "");  // either of two
    EXPECT_THAT(faultOf({3, "a\nb\nc\n"}, {3, "a\nd\n"}), HasSubstr("count up kRevision"));
    EXPECT_NE(obstacleTo({2, "b\n"}, recorded), "");
    EXPECT_NE(obstacleTo({2, "a\n"}, recorded), "");
    EXPECT_EQ(obstacleTo(recorded, recorded), "");
}

TEST(RecordedFlights, ANewRevisionIsRecorded) {
    const Recording recorded{3, "a\n"}, changed{4, "b\n"};
    EXPECT_THAT(faultOf(recorded, changed), HasSubstr("recorded at revision 3"));
    EXPECT_EQ(obstacleTo(changed, recorded), "");
    EXPECT_EQ(faultOf(recordingFrom(textOf(changed)), changed), "");
    EXPECT_EQ(obstacleTo(recorded, recordingFrom("")), "");  // the first one
}

}  // namespace
}  // namespace hagen::trials
