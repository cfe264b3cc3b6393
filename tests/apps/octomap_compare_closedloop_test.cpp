#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "support/Program.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::readFile;
using test::TemporaryFolder;

Outcome octomapCompare(const std::vector<std::string>& arguments) {
    return test::run(HAGEN_OCTOMAP_COMPARE, arguments);
}

/// A profile that does not depend on the machine that the program was made on.
fs::path someProfile(const TemporaryFolder& folder) {
    std::string text = R"({"quantiles_ms": {"filter": [0.5, 1])";
    for (const char* model : {"W-RoI", "W-Full", "G-Full", "O-Full-0.4", "oracle"}) {
        for (const char* stage : {"update", "astar", "straight", "astar+primitives",
                                  "straight+primitives", "astar+3dvfh", "straight+3dvfh"}) {
            text += std::string(", \"") + model + "/" + stage + "\": [1, 3, 9]";
        }
    }
    return folder.write("profile.json", text + "}}");
}

/// A few short flights, with whatever else is said.
std::vector<std::string> flying(const TemporaryFolder& folder, const std::string& into,
                                const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"closedloop",
                                       "--scenario",
                                       "forest-0.02",
                                       "--speed",
                                       "10",
                                       "--seeds",
                                       "1000-1002",
                                       "--models",
                                       "W-RoI,oracle",
                                       "--guidance",
                                       "straight",
                                       "--profile",
                                       someProfile(folder).string(),
                                       "-o",
                                       (folder / into).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

void expectFailure(const Outcome& outcome, int exit_code, const std::string& part) {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
}

TEST(ClosedLoopFlights, TheSameBytesForAnyJobsAndShards) {
    const TemporaryFolder folder;
    const Outcome one = octomapCompare(flying(folder, "one", {"--jobs", "1"}));
    ASSERT_EQ(one.exit_code, 0) << one.err;
    EXPECT_NE(one.out.find("runs.csv"), std::string::npos);
    EXPECT_EQ(one.err.rfind("run 0 of 6\n", 0), 0u) << one.err;  // no terminal: plain lines
    EXPECT_EQ(one.err.find('\r'), std::string::npos);
    const std::string runs = readFile(folder / "one/runs.csv");
    EXPECT_EQ(std::count(runs.begin(), runs.end(), '\n'), 7);
    ASSERT_EQ(octomapCompare(flying(folder, "two", {"--jobs", "2"})).exit_code, 0);
    EXPECT_EQ(readFile(folder / "two/runs.csv"), runs);
    for (const char* shard : {"1/3", "2/3", "3/3"}) {
        const std::string into = std::string("shard") + shard[0];
        ASSERT_EQ(octomapCompare(flying(folder, into, {"--shard", shard})).exit_code, 0);
    }
    const auto part = [&](int number) {
        return (folder / ("shard" + std::to_string(number))).string();
    };
    ASSERT_EQ(octomapCompare(
                  {"merge", part(3), part(1), part(2), part(2), "-o", (folder / "merged").string()})
                  .exit_code,
              0);
    EXPECT_EQ(readFile(folder / "merged/runs.csv"), runs);
    EXPECT_EQ(readFile(folder / "merged/campaign.json"), readFile(folder / "one/campaign.json"));
    // Nothing is left to fly.
    ASSERT_EQ(octomapCompare(flying(folder, "merged")).exit_code, 0);
    EXPECT_EQ(readFile(folder / "merged/runs.csv"), runs);
}

TEST(ClosedLoopFlights, MapsAndPathSearchesToo) {
    const TemporaryFolder folder;
    const auto fly = [&](const std::string& into, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"closedloop",
                                           "--scenario",
                                           "forest-0.05",
                                           "--speed",
                                           "10",
                                           "--seeds",
                                           "1000-1001",
                                           "--models",
                                           "W-Full,G-Full,O-Full-0.4",
                                           "--guidance",
                                           "astar",
                                           "--profile",
                                           someProfile(folder).string(),
                                           "-o",
                                           (folder / into).string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = octomapCompare(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return readFile(folder / into / "runs.csv");
    };
    const std::string runs = fly("one", {"--jobs", "1"});
    EXPECT_EQ(std::count(runs.begin(), runs.end(), '\n'), 7);
    fly("first", {"--shard", "1/2"});
    fly("second", {"--shard", "2/2", "--jobs", "2"});
    ASSERT_EQ(octomapCompare({"merge", (folder / "first").string(), (folder / "second").string(),
                              "-o", (folder / "merged").string()})
                  .exit_code,
              0);
    EXPECT_EQ(readFile(folder / "merged/runs.csv"), runs);
}

TEST(ClosedLoopFlights, KilledInFlightItGoesOnWhereItWas) {
    const TemporaryFolder folder;
    ASSERT_EQ(octomapCompare(flying(folder, "whole")).exit_code, 0);
    const auto journal = folder / "killed/journal/1.csv";
    const pid_t pid = fork();
    if (pid == 0) {
        std::vector<std::string> words = flying(folder, "killed", {"--jobs", "1", "-q"});
        words.insert(words.begin(), "octomap-compare");
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        execv(HAGEN_OCTOMAP_COMPARE, arguments.data());
        _exit(127);
    }
    for (int i = 0; i < 3000 && (!fs::exists(journal) || fs::file_size(journal) == 0); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
    ASSERT_FALSE(fs::exists(folder / "killed/runs.csv"));
    const std::string kept = readFile(journal);
    ASSERT_NE(kept, "");
    std::ofstream(journal, std::ios::app) << "forest-0.02,10";  // what a torn write leaves
    const Outcome told = octomapCompare({"report", (folder / "killed").string(), "--worst", "0"});
    ASSERT_EQ(told.exit_code, 0) << told.err;
    EXPECT_EQ(told.out.find("Unfinished: "), 0u) << told.out;
    const Outcome resumed = octomapCompare(flying(folder, "killed"));
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(readFile(folder / "killed/runs.csv"), readFile(folder / "whole/runs.csv"));
    // What was flown before is what was kept: its costs are those of then.
    const std::size_t tab = kept.find('\t');
    EXPECT_NE(readFile(folder / "killed/measured.csv")
                  .find(kept.substr(tab + 1, kept.find(';') - tab - 1)),
              std::string::npos);
}

TEST(ClosedLoopFlights, AFullDiskIsNamedAndWhatWasFinishedIsKept) {
    const TemporaryFolder folder;
    auto arguments = flying(folder, "full", {"--jobs", "1"});
    ASSERT_EQ(octomapCompare(arguments).exit_code, 0);
    const std::string finished = readFile(folder / "full/runs.csv");
    *(std::find(arguments.begin(), arguments.end(), "--seeds") + 1) = "1003-1003";
    std::string command = "ulimit -f 1; exec '" HAGEN_OCTOMAP_COMPARE "'";  // blocks of 1 KiB
    for (const std::string& word : arguments) command += " '" + word + "'";
    expectFailure(test::run("/bin/bash", {"-c", command}), 1, "full/");
    EXPECT_EQ(readFile(folder / "full/runs.csv"), finished);
    ASSERT_EQ(octomapCompare(arguments).exit_code, 0);  // once there is room
    EXPECT_EQ(readFile(folder / "full/runs.csv").rfind(finished.substr(0, 400), 0), 0u);
}

TEST(ClosedLoop, WrongUsageIsToldBeforeAnythingIsMade) {
    const TemporaryFolder folder;
    const auto fails = [&](const std::vector<std::string>& more, const std::string& part) {
        expectFailure(octomapCompare(flying(folder, "none", more)), 2, part);
        EXPECT_FALSE(fs::exists(folder / "none"));
    };
    const auto failsInstead = [&](const std::string& flag, const std::string& value,
                                  const std::string& part) {
        auto arguments = flying(folder, "none");
        *(std::find(arguments.begin(), arguments.end(), flag) + 1) = value;
        expectFailure(octomapCompare(arguments), 2, part);
        EXPECT_FALSE(fs::exists(folder / "none"));
    };
    failsInstead("--scenario", "moon", "forest-0.05");
    failsInstead("--models", "W-RoI,X-Ray", "'X-Ray'");
    failsInstead("--guidance", "psychic", "'psychic'");
    failsInstead("--seeds", "7-3", "seed");
    failsInstead("--seeds", "a-b", "'a-b'");
    failsInstead("--seeds", "-1", "seed");
    failsInstead("--speed", "0", "speed");
    fails({"--shard", "3/2"}, "shard");
    fails({"--shard", "0/2"}, "shard");
    fails({"--jobs", "0"}, "--jobs");
    fails({"--pose-error", "wild"}, "wild");
    expectFailure(octomapCompare({"closedloop"}), 2, "required");
    expectFailure(octomapCompare({"hover"}), 2, "");
    expectFailure(octomapCompare({}), 2, "");
}

TEST(ClosedLoop, ABrokenProfileOrOneWithoutAStageIsNamed) {
    const TemporaryFolder folder;
    auto arguments = flying(folder, "none");
    auto& profile = *(std::find(arguments.begin(), arguments.end(), "--profile") + 1);
    profile = folder.write("broken.json", "{").string();
    expectFailure(octomapCompare(arguments), 1, "broken.json");
    profile = folder.write("poor.json", R"({"quantiles_ms": {"filter": [1]}})").string();
    expectFailure(octomapCompare(arguments), 1, "W-RoI/update");
    profile = (folder / "missing.json").string();
    expectFailure(octomapCompare(arguments), 1, "missing.json");
    EXPECT_FALSE(fs::exists(folder / "none"));
}

TEST(ClosedLoop, FoldersOfOthersAreLeftAlone) {
    const TemporaryFolder folder;
    folder.write("mine/file.txt", "text");
    expectFailure(octomapCompare(flying(folder, "mine", {"--overwrite"})), 1, "mine");
    EXPECT_EQ(readFile(folder / "mine/file.txt"), "text");
    expectFailure(
        octomapCompare({"merge", (folder / "mine").string(), "-o", (folder / "m").string()}), 1,
        "campaign.json");
}

TEST(Calibrate, AsksForAnOutputAndKnownModels) {
    expectFailure(octomapCompare({"calibrate"}), 2, "-o");
    expectFailure(octomapCompare({"calibrate", "-o", "/nowhere/x.json", "--models", "X"}), 2, "X");
    expectFailure(octomapCompare({"calibrate", "-o", "/nowhere/x.json", "--models", "oracle"}), 1,
                  "/nowhere");
}

}  // namespace
}  // namespace hagen
