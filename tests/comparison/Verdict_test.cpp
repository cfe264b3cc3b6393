// The sentences of the verdict.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <hagen/reports/Summary.h>
#include <hagen/reports/Verdict.h>
#include "SampleRuns.h"

namespace hagen {
namespace {

using testing::HasSubstr;
using testing::Not;

using namespace test;

TEST(Verdict, ReportsWiresSeparately) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        runs.push_back(test::runOf("gap", seed, "W-RoI", "astar", kWon));
        runs.push_back(test::runOf("gap", seed, "W-Full", "astar", seed == 0 ? kHit : kWon));
        runs.push_back(test::runOf("wires", seed, "W-RoI", "astar", seed < 100 ? kHit : kWon));
        runs.push_back(test::runOf("wires", seed, "W-Full", "astar", kWon));
    }
    const reports::Summary summary = reports::summarize(runs);
    ASSERT_EQ(summary.without_wires.size(), 1u);
    EXPECT_EQ(summary.without_wires[0].pairs(), 400);
    EXPECT_EQ(summary.without_wires[0].verdict, reports::Verdict::NotInferior);
    const std::vector<std::string> words = reports::verdictOf(summary);
    EXPECT_EQ(
        words[0],
        "RoI window with A* at 4 m/s succeeds less often than full window (on wires), by more "
        "than 3 points. It is not inferior, with a margin of 3 points, to full window "
        "(without wires).");
    EXPECT_EQ(
        words[1].find("Without wires, RoI window with A* vs. full window: success 100.0 % vs. "
                      "99.8 % on the same 400 courses, +0.2 points (95 % interval "),
        0u)
        << words[1];
    EXPECT_EQ(
        words[2].find("On wires, RoI window with A* vs. full window: success 75.0 % vs. 100.0 %"),
        0u)
        << words[2];
    // If nobody flew wires, the total is already without wires.
    EXPECT_TRUE(reports::summarize({test::runOf("gap", 0, "W-RoI", "astar", kWon),
                                    test::runOf("gap", 0, "W-Full", "astar", kWon)})
                    .without_wires.empty());
}

TEST(Verdict, UsesTheSingular) {
    const std::vector<std::string> words =
        reports::verdictOf(reports::summarize({test::runOf("gap", 0, "W-RoI", "astar", kHit),
                                               test::runOf("gap", 0, "G-Full", "astar", kWon)}));
    ASSERT_EQ(words.size(), 6u);
    EXPECT_EQ(
        words[0],
        "RoI window with A* at 4 m/s: no comparison is decided yet. Undecided: occupancy grid "
        "0.2 m.");
    EXPECT_EQ(
        words[1].find("Undecided: RoI window with A* vs. occupancy grid 0.2 m: success 0.0 % vs. "
                      "100.0 % on the same 1 course, -100.0 points ("),
        0u)
        << words[1];
    EXPECT_EQ(words[2], "Undecided comparisons need more courses.");
    EXPECT_EQ(words[3].find("RoI window with A*: 1 collision in 1 run ("), 0u) << words[3];
    EXPECT_EQ(words[4], "Occupancy grid 0.2 m with A*: no collision in 1 run.");
    EXPECT_THAT(words[5], HasSubstr("after 0 collisions in 1 run of a scenario, the true"));
}

TEST(Verdict, DoesNotCallChanceALoss) {
    // The interval excludes 3 points, but among so many comparisons the test does not.
    reports::Pairing pairing{"", kReference, {"W-RoI", "astar"}, {"G-Full", "astar"}};
    pairing.both = 90;
    pairing.only_second = 10;
    pairing.difference = -0.1;
    pairing.interval = {-0.17, -0.04};
    pairing.verdict = reports::Verdict::Inferior;
    pairing.p_holm = 0.06;
    EXPECT_EQ(reports::differenceText(pairing).find("Undecided: "), 0u);
    EXPECT_THAT(reports::differenceText(pairing), HasSubstr("may be chance"));
    pairing.p_holm = 0.04;
    EXPECT_EQ(reports::differenceText(pairing).find(
                  "RoI window with A* vs. occupancy grid 0.2 m: success 90.0 % vs. 100.0 %"),
              0u);
}

TEST(Verdict, ReportsLossesThatTheTotalHides) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        for (const char* scenario : {"gap", "movers"}) {
            const bool is_gap = scenario == std::string("gap");
            runs.push_back(
                test::runOf(scenario, seed, "W-RoI", "astar", is_gap || seed < 80 ? kWon : kHit));
            runs.push_back(test::runOf(scenario, seed, "G-Full", "astar",
                                       !is_gap || seed < 78 ? kWon : kLate));
        }
    }
    const std::vector<std::string> words = reports::verdictOf(reports::summarize(runs));
    EXPECT_EQ(
        words[0],
        "RoI window with A* at 4 m/s: no comparison is decided yet. But it succeeds less often "
        "than occupancy grid 0.2 m (in movers). Undecided: occupancy grid 0.2 m.");
    EXPECT_EQ(
        words[1].find("Undecided: RoI window with A* vs. occupancy grid 0.2 m: success 90.0 % "
                      "vs. 89.0 %"),
        0u)
        << words[1];
    EXPECT_EQ(
        words[2].find("In movers, RoI window with A* vs. occupancy grid 0.2 m: success 80.0 % vs. "
                      "100.0 % on the same 100 courses, -20.0 points"),
        0u)
        << words[2];
    EXPECT_EQ(words[3], "Undecided comparisons need more courses.");
}

/// 45 of 200 lost in one of ten scenarios are less than 3 points of the total.
TEST(Verdict, ReportsLossesOnWiresThatTheTotalHides) {
    std::vector<Row> runs;
    for (const char* scenario : {"a", "b", "c", "d", "e", "f", "g", "h", "i", "wires"}) {
        const bool is_wires = scenario == std::string("wires");
        for (std::uint64_t seed = 0; seed < 200; ++seed) {
            runs.push_back(
                test::runOf(scenario, seed, "W-RoI", "astar", is_wires && seed < 45 ? kHit : kWon));
            runs.push_back(test::runOf(scenario, seed, "G-Full", "astar", kWon));
        }
    }
    const std::vector<std::string> words = reports::verdictOf(reports::summarize(runs));
    EXPECT_EQ(words[0],
              "RoI window with A* at 4 m/s, over all scenarios, succeeds less often than occupancy "
              "grid 0.2 m, by less than 3 points. But it succeeds less often than occupancy grid "
              "0.2 m (on wires).");
    EXPECT_EQ(
        words[2].find("On wires, RoI window with A* vs. occupancy grid 0.2 m: success 77.5 %"), 0u)
        << words[2];
}

TEST(Verdict, ReportsASingleScenarioOnce) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        runs.push_back(test::runOf("gap", seed, "W-RoI", "astar", seed < 5 ? kHit : kWon));
        runs.push_back(test::runOf("gap", seed, "G-Full", "astar", kWon));
    }
    const std::vector<std::string> words = reports::verdictOf(reports::summarize(runs));
    EXPECT_EQ(words[1].find("Undecided: RoI window with A* vs. occupancy grid 0.2 m"), 0u)
        << words[1];
    EXPECT_EQ(words[2], "Undecided comparisons need more courses.");
}

TEST(Verdict, NamesTheScenariosOfPartialComparisons) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        for (const char* scenario : {"gap", "u-trap"}) {
            runs.push_back(test::runOf(scenario, seed, "W-RoI", "astar", kWon));
            runs.push_back(test::runOf(scenario, seed, "G-Full", "astar", kWon));
        }
        runs.push_back(test::runOf("gap", seed, "O-Full-0.4", "astar", kWon));
    }
    const std::string headline = reports::verdictOf(reports::summarize(runs)).front();
    EXPECT_THAT(headline, HasSubstr("OctoMap 0.4 m (in gap)"));
    EXPECT_THAT(headline, Not(HasSubstr("occupancy grid 0.2 m (in")));
}

}  // namespace
}  // namespace hagen
