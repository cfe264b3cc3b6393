// The replay command of the built program.
#include <gmock/gmock.h>

#include <sstream>

#include "SampleRuns.h"
#include "avoidance/replays/ChooseRun.h"
#include "support/ProgramTest.h"

namespace hagen {
namespace {

using testing::HasSubstr;

using namespace test;

class ReplayCommand : public test::ProgramTest {
 protected:
    test::Outcome run(const std::vector<std::string>& arguments) const override {
        return test::run(HAGEN_OCTOMAP_COMPARE, arguments);
    }
    std::string folder() const { return folder_.path().string(); }
    void writeRuns(const std::vector<Row>& runs) {
        std::string text = avoidance::runHeader() + "\n";
        for (const Row& one : runs) text += avoidance::rowOf(one) + "\n";
        folder_.write("runs.csv", text);
    }
};

TEST_F(ReplayCommand, ReportsMissingTable) {
    expectFailure({"replay", folder(), "--seed=1"}, 1, "runs.csv: cannot be read");
    folder_.write("runs.csv", "");
    expectFailure({"replay", folder(), "--seed=1"}, 1, "runs.csv:1: is empty");
    writeRuns({});
    expectFailure({"replay", folder(), "--seed=1"}, 2, folder() + ": contains no runs");
}

TEST_F(ReplayCommand, UnknownCommandListsCommands) {
    const std::string commands = "commands: closedloop, calibrate, openloop, replay";
    expectFailure({"fly"}, 2, "'fly' is not a command; " + commands);
    expectFailure({}, 2, "no command given; " + commands);
}

TEST_F(ReplayCommand, SelectsRunByListedLine) {
    std::vector<Row> runs(3, test::runOf("gap", 1, "W-RoI", "astar", kWon));
    runs[1].setup.speed_m_s = 6;
    runs[2].setup.speed_m_s = 6;
    runs[2].setup.latency_scale = 4;
    runs[2].setup.brakes_in_known_space = true;
    writeRuns(runs);
    const std::string list = run({"replay", folder(), "--seed", "1"}).err;
    for (const Row& one : runs) {
        const std::string line = avoidance::choiceOf(one, runs);
        ASSERT_THAT(list, HasSubstr("\n  " + line));
        std::vector<std::string> arguments{"replay", folder(), "--seed", "1"};
        std::istringstream words(line);
        for (std::string word; words >> word && word != "#";) arguments.push_back(word);
        expectFailure(arguments, 1, "profile.json");  // selected, but not flown
    }
}

TEST_F(ReplayCommand, RequiresSingleRun) {
    writeRuns(threeContenders());
    expectFailure({"replay", folder(), "--seed", "77"}, 2, "no run with seed 77");
    expectFailure({"replay", folder(), "--seed", "1", "--model", "G-Full"}, 2,
                  "no run with seed 1");
    expectFailure({"replay", folder(), "--seed", "1"}, 2,
                  "--scenario gap --model W-RoI --guidance straight --speed 4   # timeout\n");
    expectFailure({"replay", folder()}, 2, "--seed is required");
    expectFailure({"replay", folder(), "--seed", "1", "--unknown", "nonsense"}, 2,
                  "{optimistic,brake-known}");
    for (const char* spelling : {"brake-known", "brake_known"}) {
        expectFailure({"replay", folder(), "--seed", "1", "--unknown", spelling}, 2,
                      "no run with seed 1 and these flags");
    }
    for (const char* model : {"O-Full-0.4", "OctoMap 0.4 m", "octomap 0.4 m"}) {
        expectFailure({"replay", folder(), "--seed", "1", "--model", model}, 1, "profile.json");
    }
}

}  // namespace
}  // namespace hagen
