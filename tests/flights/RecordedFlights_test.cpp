// Some short flights must match the recorded ones exactly, unless kRevision was incremented.
#include <gmock/gmock.h>
#include <hagen/avoidance/Trial.h>
#include "avoidance/flights/Calibration.h"
#include "avoidance/flights/RunTable.h"
#include "avoidance/flights/SettingsHash.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "support/Program.h"

namespace hagen::avoidance {
namespace {

const char kFile[] = HAGEN_SOURCE_DIR "/tests/flights/recorded_flights.csv";
const std::string kHowToRecord =
    "increment kRevision in libs/avoidance/flights/SettingsHash.h, and record "
    "again: "
    "HAGEN_RECORD_FLIGHTS=1 scripts/test -R RecordedFlights";

/// Recorded flights: "revision,N", then rows as in runs.csv. A flight may have several rows:
/// depending on the machine, its result is one of them (docs/octomap-compare.md).
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

/// Keys of the flights: the first five columns of each row and the last three, air, distance and
/// updates.
std::set<std::string> flightsOf(const std::vector<std::string>& rows) {
    std::set<std::string> flights;
    for (const std::string& row : rows) {
        std::size_t five = 0;
        for (int k = 0; k < 5 && five != std::string::npos; ++k) five = row.find(',', five + 1);
        std::size_t last_three = row.size();
        for (int k = 0; k < 3 && last_three > 0; ++k) last_three = row.rfind(',', last_three - 1);
        flights.insert(row.substr(0, five) + row.substr(last_three));
    }
    return flights;
}

/// Why the recording differs from the flights of this revision; empty if it does not.
std::string errorOf(const Recording& recording, const Recording& flown) {
    if (recording.revision != flown.revision) {
        return "recorded at revision " + std::to_string(recording.revision) +
               ", but kRevision is " + std::to_string(flown.revision) +
               "; if it was incremented, record again: HAGEN_RECORD_FLIGHTS=1 scripts/test -R "
               "RecordedFlights";
    }
    const std::vector<std::string> rows = linesOf(flown.rows), recorded = linesOf(recording.rows);
    const std::set<std::string> known(recorded.begin(), recorded.end());
    const bool are_known = std::all_of(
        rows.begin(), rows.end(), [&](const std::string& row) { return known.count(row) > 0; });
    if (are_known && flightsOf(rows) == flightsOf(recorded)) return "";
    return "flights differ from the recorded ones; if the change is intended, " + kHowToRecord;
}

/// Why these flights may not replace the recorded ones; empty if they may.
std::string obstacleTo(const Recording& flown, const Recording& recorded) {
    if (flown.revision > recorded.revision || textOf(flown) == textOf(recorded)) return "";
    return "flights or kRevision changed, but kRevision was not incremented; first " + kHowToRecord;
}

/// Latencies independent of the installed profile.
LatencyProfile someProfile() {
    LatencyProfile profile = constantProfile(1);
    for (auto& [stage, quantiles_ms] : profile.quantiles_ms) quantiles_ms = {2, 5, 8, 40};
    return profile;
}

/// Flights with every scenario, air, guidance, planner, pose error and kind of model at least once.
/// They are short, and changing the LiDAR's rays by 1e-6 (more than processors differ) does not
/// change their results.
std::vector<std::string> keys() {
    return {"forest-0.02,1,W-RoI,straight,10,primitives,none,1,optimistic,dusty,unbiased,scans",
            "forest-0.02,5,O-RoI-0.4,straight,10,3dvfh,noise,1,optimistic,dusty,unbiased,scans",
            "forest-0.05,2,W-RoI,straight,10,3dvfh,noise,1,optimistic,dusty,unbiased,scans",
            "forest-0.10,6,W-RoI,astar,6,3dvfh,none,1,optimistic,dusty,unbiased,scans",
            "orchard,6,O-Full-0.4,straight,10,3dvfh,none,1,optimistic,dusty,unbiased,scans",
            "gap,5,O-Full-0.4,astar,8,primitives,none,1,optimistic,dusty,unbiased,scans",
            "u-trap,6,oracle,astar,10,primitives,none,1,optimistic,dusty,unbiased,scans",
            "terrain,6,W-Full,astar,10,primitives,drift,1,optimistic,dusty,unbiased,scans",
            "wires,2,O-RoI+rays-0.4,straight,10,primitives,none,1,brake_known,dusty,unbiased,scans",
            "movers,1,W-RoI,astar,10,primitives,noise,4,optimistic,dusty,unbiased,scans",
            "street,10,G-Full,straight,10,3dvfh,none,1,optimistic,dusty,unbiased,scans",
            "forest-0.02,1,W-RoI,straight,10,primitives,none,1,optimistic,clear,as-stored,scans"};
}

Recording fly() {
    const LatencyProfile profile = someProfile();
    Recording flown{kRevision, runHeader() + "\n"};
    for (const std::string& key : keys()) {
        hagen::avoidance::Run run = runOfKey(key);
        const Course course = makeCourse(run.scenario, run.seed);
        run.oracle_path_m = course.oracle_path_m;
        run.result = runTrial(course, run.setup, profile);
        flown.rows += rowOf(run) + "\n";
    }
    return flown;
}

TEST(RecordedFlights, MatchRecording) {
    const Recording recorded = recordingFrom(test::readFile(kFile)), flown = fly();
    if (std::getenv("HAGEN_RECORD_FLIGHTS") != nullptr) {
        ASSERT_EQ(obstacleTo(flown, recorded), "");
        std::ofstream(kFile, std::ios::binary) << textOf(flown);
        return;
    }
    EXPECT_EQ(errorOf(recorded, flown), "") << "recorded:\n"
                                            << recorded.rows << "flown:\n"
                                            << flown.rows;
}

}  // namespace
}  // namespace hagen::avoidance
