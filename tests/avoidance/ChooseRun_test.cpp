// Selection of the run to replay, and errors if none or several match.
#include <gtest/gtest.h>
#include <stdexcept>

#include "SampleRuns.h"
#include "avoidance/replays/ChooseRun.h"

namespace hagen {
namespace {

using namespace test;

TEST(ChooseRun, FileNamesAreUnique) {
    Row run = test::runOf("forest-0.10", 7, "O-RoI+rays-0.4", "astar", kWon);
    EXPECT_EQ(avoidance::fileNameOf(run), "forest-0.10-7-O-RoI+rays-0.4-astar-4mps");
    run.setup.speed_m_s = 2.5;
    run.setup.planner = "3dvfh";
    run.setup.pose_error = avoidance::PoseError::Noise;
    run.setup.latency_scale = 4;
    run.setup.brakes_in_known_space = true;
    run.setup.air = avoidance::Air::Clear;
    run.setup.distance = avoidance::ModelDistance::AsStored;
    EXPECT_EQ(avoidance::fileNameOf(run),
              "forest-0.10-7-O-RoI+rays-0.4-astar-2.5mps-3dvfh-noise-latency4-brake-known-clear-"
              "as-stored");
}

TEST(ChooseRun, ListsAvailableRuns) {
    const std::vector<Row> runs = threeContenders();
    avoidance::RunWanted wanted;
    wanted.seed = 77;
    const auto refusal = [&wanted](const std::vector<Row>& among) -> std::string {
        try {
            return avoidance::chooseRun(among, wanted).scenario;
        } catch (const std::invalid_argument& e) {
            return e.what();
        }
    };
    EXPECT_EQ(refusal(runs),
              "has no run with seed 77; available:\n  gap: seeds 0-9, 4 m/s, O-Full-0.4,W-RoI, "
              "astar,straight");
    wanted.seed = 3;
    wanted.model = "G-Full";
    EXPECT_EQ(refusal(runs),
              "has no run with seed 3 and these flags; available:\n  gap: seed 3, 4 m/s, "
              "O-Full-0.4,W-RoI, astar,straight");
    EXPECT_EQ(refusal({}), "contains no runs");
}

TEST(ChooseRun, ListsDistinguishingFlags) {
    const Row plain = test::runOf("gap", 1, "W-RoI", "astar", kWon);
    std::vector<Row> runs(6, plain);
    runs[1].setup.speed_m_s = 0.1 + 0.2;  // has 17 significant digits
    runs[2].setup.latency_scale = 4;
    runs[3].setup.planner = "3dvfh";
    runs[4].setup.pose_error = avoidance::PoseError::Noise;
    runs[5].setup.brakes_in_known_space = true;
    const std::string named = "--scenario gap --model W-RoI --guidance astar --speed ";
    EXPECT_EQ(avoidance::choiceOf(plain, {plain}), named + "4   # success");
    EXPECT_EQ(avoidance::choiceOf(runs[2], {runs[2]}), named + "4 --latency-scale 4   # success");
    EXPECT_EQ(avoidance::choiceOf(plain, {plain, runs[2]}),
              named + "4 --latency-scale 1   # success");
    EXPECT_EQ(avoidance::choiceOf(runs[1], runs),
              named +
                  "0.30000000000000004 --planner primitives --pose-error none --latency-scale 1 "
                  "--unknown optimistic   # success");
    EXPECT_EQ(avoidance::choiceOf(runs[5], {plain, runs[5]}),
              named + "4 --unknown brake-known   # success");
}

TEST(ChooseRun, SelectsByCondition) {
    std::vector<Row> runs{test::runOf("gap", 1, "W-RoI", "astar", kWon),
                          test::runOf("gap", 1, "W-RoI", "astar", kHit)};
    runs[1].setup.air = avoidance::Air::Clear;
    avoidance::RunWanted wanted;
    wanted.seed = 1;
    wanted.air = "clear";
    EXPECT_EQ(avoidance::chooseRun(runs, wanted).setup.air, avoidance::Air::Clear);
    EXPECT_EQ(avoidance::choiceOf(runs[0], runs),
              "--scenario gap --model W-RoI --guidance astar --speed 4 --air dusty   # success");
    runs[1].setup = runs[0].setup;
    runs[1].setup.distance = avoidance::ModelDistance::AsStored;
    wanted.air = "dusty";
    wanted.distance = "as-stored";
    EXPECT_EQ(avoidance::chooseRun(runs, wanted).setup.distance,
              avoidance::ModelDistance::AsStored);
    EXPECT_EQ(avoidance::choiceOf(runs[1], runs),
              "--scenario gap --model W-RoI --guidance astar --speed 4 --distance as-stored   "
              "# collision");
    runs[1].setup = runs[0].setup;
    runs[1].setup.updates = avoidance::Updates::Sectors;
    wanted.distance = "";
    wanted.updates = "sectors";
    EXPECT_EQ(avoidance::chooseRun(runs, wanted).setup.updates, avoidance::Updates::Sectors);
    EXPECT_EQ(avoidance::choiceOf(runs[1], runs),
              "--scenario gap --model W-RoI --guidance astar --speed 4 --updates sectors   "
              "# collision");
    EXPECT_NE(avoidance::fileNameOf(runs[0]), avoidance::fileNameOf(runs[1]));
}

}  // namespace
}  // namespace hagen
