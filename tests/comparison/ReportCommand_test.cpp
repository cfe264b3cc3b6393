// The report and the replay of the built program; campaigns that are flown meanwhile.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/trials/MeasuredTable.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include <hagen/replays/ChooseRun.h>
#include <hagen/reports/WriteReport.h>
#include <hagen/trials/Calibration.h>
#include <hagen/trials/FlownRuns.h>
#include <hagen/trials/LatencyProfile.h>
#include "SampleRuns.h"
#include "support/ProgramTest.h"

namespace hagen {
namespace {

using testing::HasSubstr;
using testing::Not;

using namespace test;
namespace fs = std::filesystem;

/// A line of a journal.
std::string lineOf(const Row& run, double peak_model_bytes) {
    trials::TrialMeasurement measurement;
    measurement.peak_model_bytes = peak_model_bytes;
    return trials::rowOf(run) + "\t" + trials::measuredRowOf(run, measurement) + ";\n";
}

class ReportCommand : public test::ProgramTest {
 protected:
    test::Outcome run(const std::vector<std::string>& arguments) const override {
        return test::run(HAGEN_OCTOMAP_COMPARE, arguments);
    }
    std::string folder() const { return folder_.path().string(); }
    void writeRuns(const std::vector<Row>& runs) {
        std::string text = trials::runHeader() + "\n";
        for (const Row& one : runs) text += trials::rowOf(one) + "\n";
        folder_.write("runs.csv", text);
    }
};

TEST_F(ReportCommand, TellsOfRunsAsPageJsonCsvAndMarkdown) {
    writeRuns(threeContenders());
    const test::Outcome outcome = run({"report", folder(), "--markdown", path("a.md")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(
        outcome.out,
        HasSubstr("after 0 collisions in 10 runs of a scenario, the true collision rate can still "
                  "be up to 27.8 %"));
    std::ifstream in(path("summary.json"));
    const auto json = nlohmann::json::parse(in);
    EXPECT_EQ(json["runs"], 30);
    EXPECT_EQ(json["pairings"].size(), 3u);
    EXPECT_THAT(test::readFile(path("summary.csv")),
                HasSubstr("gap,4.0000,primitives,none,1.0000,"
                          "optimistic,W-RoI,astar,10,9,0.9000,0.5958,"));
    const std::string page = test::readFile(path("report.html"));
    EXPECT_THAT(page, HasSubstr("90.0 <small>(59.6 to 98.2)</small>"));
    EXPECT_THAT(page, HasSubstr("no profile.json"));  // worst runs
    EXPECT_THAT(test::readFile(path("a.md")), HasSubstr("| gap | 90.0 (59.6 to 98.2; 10) |"));
}

TEST_F(ReportCommand, TellsWhatRunsCostAsMeasured) {
    writeRuns(threeContenders());
    folder_.write("measured.csv",
                  "model,air,distance,speed,filter_p50_ms,filter_p95_ms,update_p50_ms,"
                  "peak_model_bytes\n"
                  "W-RoI,dusty,unbiased,4,0.8,9,1.25,2000000\n"
                  "W-RoI,dusty,unbiased,4,0.6,9,1.75,4000000\n"
                  "W-RoI,dusty,unbiased,10,6,90,17,40000000\n"  // another condition
                  "G-Full,dusty,unbiased,4,,,14,1\n");
    ASSERT_EQ(run({"report", folder(), "--markdown", path("a.md")}).exit_code, 0);
    const std::string text = test::readFile(path("a.md"));
    EXPECT_THAT(text, HasSubstr("| RoI window, A* | 2 | 3.00 | 4.00 | 0.70 | 1.50 |"));
    EXPECT_THAT(text, HasSubstr("| occupancy grid 0.2 m, A* | 1 | 0.00 | 0.00 | - | 14.00 |"));
}

TEST_F(ReportCommand, NamesTheLineThatContradictsAnother) {
    writeRuns({test::runOf("gap", 1, "W-RoI", "astar", kWon)});
    fs::create_directory(path("journal"));
    folder_.write("journal/1.csv", lineOf(test::runOf("gap", 1, "W-RoI", "astar", kWon), 1));
    EXPECT_EQ(run({"report", folder()}).exit_code, 0);
    folder_.write("journal/1.csv", lineOf(test::runOf("gap", 1, "W-RoI", "astar", kHit), 1));
    expectFailure({"report", folder(), "--overwrite"}, 1, "journal/1.csv:1: contradicts another");
}

TEST_F(ReportCommand, TellsHowMuchOfACampaignIsFlown) {
    // Planned: 2 models, 10 seeds. One is in the table, others in a journal whose end is torn.
    fs::create_directory(path("journal"));
    std::string journal;
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
        journal += lineOf(test::runOf("gap", seed, "W-RoI", "astar", kWon), 1e6 * double(seed));
    }
    folder_.write("journal/1.csv", journal + "gap,4,W-");
    folder_.write("campaign.json", R"({"flown": [{"scenarios": ["gap"], "seeds": [0, 9],
        "speeds_m_s": [4.0], "models": ["W-RoI", "G-Full"], "guidances": ["astar"],
        "planners": ["primitives"], "pose_errors": ["none"], "latency_scales": [1.0],
        "unknown": "optimistic", "airs": ["dusty"], "distances": ["unbiased"]}]})");
    const test::Outcome before = run({"report", folder()});  // no runs.csv yet
    ASSERT_EQ(before.exit_code, 0) << before.err;
    EXPECT_THAT(before.out, HasSubstr("Unfinished: 3 of 20 planned runs are done."));
    writeRuns({test::runOf("gap", 0, "W-RoI", "astar", kWon)});
    const test::Outcome outcome =
        run({"report", folder(), "--overwrite", "--markdown", path("a.md")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("Unfinished: 4 of 20 planned runs are done."));
    for (const char* name : {"report.html", "a.md"}) {
        EXPECT_THAT(test::readFile(path(name)), HasSubstr("4 of 20 planned runs"));
    }
    const std::string text = test::readFile(path("a.md"));
    EXPECT_THAT(text, HasSubstr("| 4 m/s | RoI window, A* | 4 | 10 |"));
    EXPECT_THAT(text, HasSubstr("| 4 m/s | occupancy grid 0.2 m, A* | 0 | 10 |"));
    EXPECT_THAT(text, HasSubstr("| RoI window, A* | 3 | 2.00 | 3.00 |"));  // measured
    std::ifstream in(path("summary.json"));
    EXPECT_EQ(nlohmann::json::parse(in)["missing_runs"], 16);

    std::vector<Row> all;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        all.push_back(test::runOf("gap", seed, "W-RoI", "astar", kWon));
        all.push_back(test::runOf("gap", seed, "G-Full", "astar", kWon));
    }
    writeRuns(all);
    EXPECT_THAT(run({"report", folder(), "--overwrite"}).out, Not(HasSubstr("Unfinished")));
    folder_.write("campaign.json", "{}");
    EXPECT_THAT(run({"report", folder(), "--overwrite"}).err, HasSubstr("campaign.json: "));
}

TEST(FlownRuns, AreReadAnewWhereTheCampaignEndsMeanwhile) {
    const test::TemporaryFolder folder;
    const Row run = test::runOf("gap", 1, "W-RoI", "astar", kWon);
    fs::create_directory(folder / "journal");
    // A long one holds the reader up between its list of journals and the second of them.
    std::string lines;
    for (int line = 0; line < 20000; ++line) lines += lineOf(run, 0);
    folder.write("journal/0.csv", lines);
    folder.write("journal/1.csv", lineOf(run, 0));
    const int opened = inotify_init1(IN_CLOEXEC);
    ASSERT_GE(inotify_add_watch(opened, (folder / "journal/0.csv").c_str(), IN_OPEN), 0);
    std::thread campaign([&] {
        char event[4096];
        EXPECT_GT(read(opened, event, sizeof event), 0);  // waits for the reader
        close(opened);
        folder.write("runs.csv", trials::runHeader() + "\n" + trials::rowOf(run) + "\n");
        fs::remove_all(folder / "journal");
    });
    trials::FlownRuns flown;
    EXPECT_NO_THROW(flown = trials::readFlownRuns(folder.path()));
    campaign.join();
    EXPECT_EQ(flown.runs.size(), 1u);
}

TEST(FlownRuns, OfAJournalThatCannotBeReadAreAnError) {
    const test::TemporaryFolder folder;
    fs::create_directory(folder / "journal");
    fs::create_symlink("nowhere", folder / "journal/0.csv");
    EXPECT_THAT(test::messageOf([&] { trials::readFlownRuns(folder.path()); }),
                HasSubstr("0.csv: cannot be read"));
}

TEST_F(ReportCommand, ReplacesNothingOfTheCampaignByItsMarkdown) {
    writeRuns(threeContenders());
    for (const char* name : {"runs.csv", "report.html", "./runs.csv"}) {
        expectFailure({"report", folder(), "--overwrite", "--markdown", folder() + "/" + name}, 1,
                      folder());
    }
}

TEST_F(ReportCommand, LeavesAnEarlierReportAloneUnlessTold) {
    writeRuns(threeContenders());
    folder_.write("summary.csv", "mine");
    expectFailure({"report", folder()}, 1, "summary.csv exists; use --overwrite");
    EXPECT_EQ(test::readFile(path("summary.csv")), "mine");
    EXPECT_EQ(run({"report", folder(), "--overwrite"}).exit_code, 0);
}

TEST_F(ReportCommand, NamesWhatIsMissing) {
    expectFailure({"report", path("nowhere")}, 1, "nowhere: no such folder");
    for (const char* command : {"report", "replay"}) {
        expectFailure(
            {command, folder(), command == std::string("replay") ? "--seed=1" : "--worst=6"}, 1,
            folder() + ": contains no campaign; expected a folder of octomap-compare");
    }
    writeRuns({});
    expectFailure({"report", folder()}, 1,
                  folder() + ": no run is finished yet; run octomap-compare closedloop");
    folder_.write("runs.csv", "");
    expectFailure({"report", folder()}, 1, "runs.csv:1: is empty");
    expectFailure({"report"}, 2, "DIR is required");
    // A campaign that has only begun, and one with a plan that this version does not know.
    fs::remove(path("runs.csv"));
    folder_.write("campaign.json", R"({"flown": []})");
    expectFailure({"report", folder()}, 1, folder() + ": no run is finished yet");
    expectFailure({"replay", folder(), "--seed", "1"}, 2,
                  folder() + ": has no run of seed 1, nor any other");
    folder_.write("campaign.json", R"({"flown": [{"scenarios": ["moon"], "seeds": [0, 9],
        "speeds_m_s": [4.0], "models": ["W-RoI"], "guidances": ["astar"],
        "planners": ["primitives"], "pose_errors": ["none"], "latency_scales": [1.0],
        "unknown": "optimistic", "airs": ["dusty"], "distances": ["unbiased"]}]})");
    expectFailure({"report", folder()}, 1, "was it written by another version");
}

TEST_F(ReportCommand, NamesTheLineThatIsBroken) {
    folder_.write("runs.csv",
                  trials::runHeader() + "\n" + trials::rowOf(threeContenders()[0]) + "\ngap,1\n");
    expectFailure({"report", folder()}, 1, "runs.csv:3: 2 fields, not 26");
    Row again = threeContenders()[0];
    again.result.outcome = kHit;
    writeRuns({threeContenders()[0], threeContenders()[1], again});
    expectFailure({"report", folder()}, 1, "runs.csv:4: a run that an earlier line has");
    again.result.min_clearance_m = std::numeric_limits<double>::infinity();
    writeRuns({again});
    expectFailure({"report", folder()}, 1,
                  "runs.csv:2: column min_clearance_m: \"inf\" is not finite");
    writeRuns(threeContenders());
    folder_.write("memory.csv", "model,path_m,bytes\nW-RoI,far,1\n");
    expectFailure({"report", folder()}, 1, "memory.csv:2: not model,path_m,bytes");
    folder_.write("memory.csv", "model,path_m,bytes\n");
    folder_.write("measured.csv", "model,peak_model_bytes\nW-RoI,2e6\nW-RoI,much\n");
    expectFailure({"report", folder()}, 1, "measured.csv:3: \"much\" is not a number");
    folder_.write("measured.csv", "model,peak_model_bytes\n");
    folder_.write("profile.json", "{");
    expectFailure({"report", folder()}, 1, "profile.json");
}

TEST_F(ReportCommand, CanBeEndedBeforeEachRunAndBeforeItWrites) {
    writeRuns({test::runOf("nowhere", 1, "W-RoI", "astar", kHit),
               test::runOf("no such", 2, "W-RoI", "astar", kHit)});
    folder_.write("profile.json", textOf(trials::constantProfile(1)));
    reports::ReportRequest request;
    request.folder = folder_.path();
    int asked = 0, last = 0;
    request.continuing = [&] {
        if (++asked > last) throw std::runtime_error("interrupted");
    };
    for (last = 0; last < 5; ++last) {
        asked = 0;
        EXPECT_EQ(test::messageOf([&] { reports::writeReport(request); }), "interrupted");
        EXPECT_FALSE(fs::exists(path("report.html")));
    }
    asked = 0;
    EXPECT_EQ(test::messageOf([&] { reports::writeReport(request); }), "");
    EXPECT_TRUE(fs::exists(path("report.html")));
}

TEST_F(ReportCommand, SaysWhereItCannotWrite) {
    writeRuns(threeContenders());
    fs::create_directory(path("report.html"));
    const test::Outcome outcome = run({"report", folder(), "--overwrite"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("report.html"));
    fs::remove(path("report.html"));
    expectFailure({"report", folder(), "--markdown", path("no/a.md")}, 1, path("no"));
    if (fs::exists("/proc/version")) {
        fs::remove(path("runs.csv"));
        expectFailure({"report", "/proc"}, 1, "/proc: contains no campaign");
    }
}

TEST_F(ReportCommand, AnUnknownCommandIsToldWhichThereAre) {
    const std::string there_are =
        "there are closedloop, merge, calibrate, distances, openloop, report, replay";
    expectFailure({"fly"}, 2, "'fly' is not a command; " + there_are);
    expectFailure({}, 2, "no command given; " + there_are);
}

TEST_F(ReportCommand, ALineOfTheListChoosesItsRun) {
    std::vector<Row> runs(3, test::runOf("gap", 1, "W-RoI", "astar", kWon));
    runs[1].setup.speed_m_s = 6;
    runs[2].setup.speed_m_s = 6;
    runs[2].setup.latency_scale = 4;
    runs[2].setup.brakes_in_known_space = true;
    writeRuns(runs);
    const std::string list = run({"replay", folder(), "--seed", "1"}).err;
    for (const Row& one : runs) {
        const std::string line = replays::choiceOf(one, runs);
        ASSERT_THAT(list, HasSubstr("\n  " + line));
        std::vector<std::string> arguments{"replay", folder(), "--seed", "1"};
        std::istringstream words(line);
        for (std::string word; words >> word && word != "#";) arguments.push_back(word);
        expectFailure(arguments, 1, "profile.json");  // chosen; it cannot be flown here
    }
}

TEST_F(ReportCommand, AReplayNeedsOneRun) {
    writeRuns(threeContenders());
    expectFailure({"replay", folder(), "--seed", "77"}, 2, "no run of seed 77");
    expectFailure({"replay", folder(), "--seed", "1", "--model", "G-Full"}, 2, "no run of seed 1");
    expectFailure({"replay", folder(), "--seed", "1"}, 2,
                  "--scenario gap --model W-RoI --guidance straight --speed 4   # timeout\n");
    expectFailure({"replay", folder()}, 2, "--seed is required");
    expectFailure({"replay", folder(), "--seed", "1", "--unknown", "nonsense"}, 2,
                  "{optimistic,brake-known}");
    for (const char* spelling : {"brake-known", "brake_known"}) {
        expectFailure({"replay", folder(), "--seed", "1", "--unknown", spelling}, 2,
                      "no run of seed 1 with these flags");
    }
    for (const char* model : {"O-Full-0.4", "OctoMap 0.4 m", "octomap 0.4 m"}) {
        expectFailure({"replay", folder(), "--seed", "1", "--model", model}, 1, "profile.json");
    }
}

}  // namespace
}  // namespace hagen
