#include <gmock/gmock.h>

#include <iterator>
#include <sstream>

#include "support/Program.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::readFile;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Outcome octomapCompare(const std::vector<std::string>& arguments) {
    return test::run(HAGEN_OCTOMAP_COMPARE, arguments);
}

/// A latency profile that does not depend on the build machine.
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

/// Arguments of a few short flights, with additional arguments.
std::vector<std::string> flying(const TemporaryFolder& folder, const std::string& into,
                                const std::vector<std::string>& more = {},
                                const std::string& flights =
                                    "--scenario forest-0.02 --speed 10 --seeds 1000-1002 "
                                    "--models W-RoI,oracle --guidance straight") {
    std::istringstream words("closedloop " + flights + " --profile");
    std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
    arguments.insert(arguments.end(),
                     {someProfile(folder).string(), "-o", (folder / into).string()});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

void expectFailure(const Outcome& outcome, int exit_code, const std::string& part) {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(part));
}

/// The header, and the rows in alphabetical order.
std::vector<std::string> sortedLines(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    if (!lines.empty()) std::sort(lines.begin() + 1, lines.end());
    return lines;
}

/// The sorted lines of all tables, which share a header.
std::vector<std::string> concatenated(const std::vector<fs::path>& tables) {
    std::string text;
    for (const fs::path& table : tables) {
        const std::string one = readFile(table);
        text += text.empty() ? one : one.substr(one.find('\n') + 1);
    }
    return sortedLines(text);
}

TEST(ClosedLoopFlights, JobsAndShardsDoNotChangeRows) {
    const TemporaryFolder folder;
    const Outcome one = octomapCompare(flying(folder, "one", {"--jobs", "1"}));
    ASSERT_EQ(one.exit_code, 0) << one.err;
    EXPECT_THAT(one.out, HasSubstr("runs.csv"));
    EXPECT_EQ(one.err.rfind("run 0 of 6\n", 0), 0u) << one.err;  // no terminal: plain lines
    EXPECT_THAT(one.err, Not(HasSubstr("\r")));
    const std::string runs = readFile(folder / "one/runs.csv");
    EXPECT_EQ(std::count(runs.begin(), runs.end(), '\n'), 7);
    auto two = flying(folder, "two", {"--jobs", "2"});
    *(std::find(two.begin(), two.end(), "--models") + 1) = "RoI window,true scene";
    ASSERT_EQ(octomapCompare(two).exit_code, 0);
    EXPECT_EQ(readFile(folder / "two/runs.csv"), runs);
    EXPECT_EQ(readFile(folder / "two/campaign.json"), readFile(folder / "one/campaign.json"));
    EXPECT_THAT(one.out, AllOf(HasSubstr(" RoI window "), HasSubstr(" true scene ")));
    std::vector<fs::path> tables;
    for (const char* shard : {"1/3", "2/3", "3/3"}) {
        const std::string into = std::string("shard") + shard[0];
        ASSERT_EQ(octomapCompare(flying(folder, into, {"--shard", shard})).exit_code, 0);
        tables.push_back(folder / into / "runs.csv");
    }
    EXPECT_EQ(concatenated(tables), sortedLines(runs));
    // All flights are finished, so the program flies none.
    ASSERT_EQ(octomapCompare(flying(folder, "one")).exit_code, 0);
    EXPECT_EQ(readFile(folder / "one/runs.csv"), runs);
}

TEST(ClosedLoopFlights, SectorsDoNotChangeScanRows) {
    const TemporaryFolder folder;
    const auto fly = [&](const std::string& into, const std::string& updates,
                         const std::string& jobs) {
        const Outcome outcome = octomapCompare(
            {"closedloop", "--scenario", "forest-0.02", "--speed", "10", "--seeds", "1000-1001",
             "--profile", someProfile(folder).string(), "--models", "W-RoI", "--updates", updates,
             "--jobs", jobs, "-o", (folder / into).string()});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.out.find("RoI window, sectors") != std::string::npos, updates != "scans");
        return readFile(folder / into / "runs.csv");
    };
    const std::string scans = fly("scans", "scans", "1");
    const std::string both = fly("both", "all", "1");
    EXPECT_EQ(fly("two", "scans,sectors", "2"), both);
    std::istringstream rows(scans), all(both);
    std::string header, row, full, sectors;
    std::getline(rows, header);
    std::getline(all, full);
    EXPECT_EQ(full, header);
    std::vector<std::string> of_scans, of_sectors;
    while (std::getline(all, full)) {
        const bool is_scans = full.find(",scans") != std::string::npos;
        (is_scans ? of_scans : of_sectors).push_back(full);
    }
    ASSERT_EQ(of_scans.size(), 2u);
    ASSERT_EQ(of_sectors.size(), 2u);
    for (const std::string& one : of_scans) {
        std::getline(rows, row);
        EXPECT_EQ(one, row);
    }
    EXPECT_NE(of_sectors, of_scans);
    // Running both into the same folder is equivalent.
    fly("scans", "sectors", "1");
    EXPECT_EQ(readFile(folder / "scans/runs.csv"), both);
}

TEST(ClosedLoopFlights, KeepsFinishedRunsOnFullDisk) {
    const TemporaryFolder folder;
    auto arguments = flying(folder, "full", {"--jobs", "1"});
    ASSERT_EQ(octomapCompare(arguments).exit_code, 0);
    const std::string finished = readFile(folder / "full/runs.csv");
    *(std::find(arguments.begin(), arguments.end(), "--seeds") + 1) = "1003-1003";
    std::string command = "ulimit -f 1; exec '" HAGEN_OCTOMAP_COMPARE "'";  // in blocks of 1 KiB
    for (const std::string& word : arguments) command += " '" + word + "'";
    expectFailure(test::run("/bin/bash", {"-c", command}), 1, "full/");
    EXPECT_EQ(readFile(folder / "full/runs.csv"), finished);
    ASSERT_EQ(octomapCompare(arguments).exit_code, 0);  // without the file size limit
    EXPECT_EQ(readFile(folder / "full/runs.csv").rfind(finished.substr(0, 400), 0), 0u);
}

TEST(ClosedLoop, RejectsInvalidArgumentsBeforeWriting) {
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
    failsInstead("--models", "W-RoI,X-Ray",
                 "unknown world model 'X-Ray'; known: W-RoI (RoI window), ");
    failsInstead("--models", "RoI window,RoI windows", "'RoI windows'");
    failsInstead("--guidance", "psychic", "'psychic'");
    failsInstead("--seeds", "7-3", "seed");
    failsInstead("--seeds", "0-18446744073709551615", "more than 1000000 flights");
    failsInstead("--seeds", "a-b", "'a-b'");
    failsInstead("--seeds", "-1", "seed");
    failsInstead("--speed", "0", "speed");
    fails({"--shard", "3/2"}, "shard");
    fails({"--shard", "4294967297/4294967298"}, "shard");
    fails({"--shard", "0/2"}, "shard");
    fails({"--jobs", "0"}, "--jobs");
    fails({"--air", "all,clear"}, "--air: all cannot be combined with other values");
    failsInstead("--models", "W-RoI,all", "--models: all cannot be combined with other values");
    failsInstead("--models", "W-RoI,RoI window", "W-RoI is given twice");
    failsInstead("--speed", "4,4.0", "--speed: 4 is given twice");
    fails({"--pose-error", "wild"}, "wild");
    fails({"--updates", "turns"}, "turns");
    fails({"--updates", "scans,sectors", "--models", "W-RoI+motion"}, "tracks the obstacles");
    expectFailure(octomapCompare({"closedloop"}), 2, "required");
    expectFailure(octomapCompare({"hover"}), 2, "");
    expectFailure(octomapCompare({}), 2, "");
}

TEST(Calibrate, RequiresOutputAndKnownModels) {
    expectFailure(octomapCompare({"calibrate"}), 2, "-o");
    expectFailure(octomapCompare({"calibrate", "-o", "/proc/none/x.json", "--models", "X"}), 2,
                  "X");
    expectFailure(octomapCompare({"calibrate", "-o", "/proc/none/x.json", "--models", "X"}), 2,
                  "known: W-RoI (RoI window), ");
    for (const char* model : {"oracle", "true scene", "RoI window,OctoMap 0.4 m", "all"}) {
        expectFailure(octomapCompare({"calibrate", "-o", "/proc/none/x.json", "--models", model}),
                      1, "/proc/none");
    }
}

}  // namespace
}  // namespace hagen
