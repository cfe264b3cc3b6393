// What is said of figures.
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

TEST(Verdict, TellsWiresApartFromTheRest) {
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
    EXPECT_EQ(words[0],
              "W-RoI with A* at 4 m/s arrives less often than W-Full (among wires), by more than "
              "3 points. It loses less than 3 points, if any, to W-Full (where no wires are).");
    EXPECT_EQ(
        words[1].find("Where no wires are, W-RoI with A* against W-Full: success 100.0 % against "
                      "99.8 % of the same 400 courses, +0.2 points (95 % interval "),
        0u)
        << words[1];
    EXPECT_EQ(
        words[2].find("Among wires, W-RoI with A* against W-Full: success 75.0 % against 100.0 %"),
        0u)
        << words[2];
    // Where nobody flew wires, all is where no wires are.
    EXPECT_TRUE(reports::summarize({test::runOf("gap", 0, "W-RoI", "astar", kWon),
                                    test::runOf("gap", 0, "W-Full", "astar", kWon)})
                    .without_wires.empty());
}

TEST(Verdict, SpeaksOfOneAsOne) {
    const std::vector<std::string> words =
        reports::verdictOf(reports::summarize({test::runOf("gap", 0, "W-RoI", "astar", kHit),
                                               test::runOf("gap", 0, "G-Full", "astar", kWon)}));
    ASSERT_EQ(words.size(), 6u);
    EXPECT_EQ(words[0], "W-RoI with A* at 4 m/s: nothing is decided yet. Open: G-Full.");
    EXPECT_EQ(words[1].find(
                  "Open: W-RoI with A* against G-Full: success 0.0 % against 100.0 % of the same "
                  "1 course, -100.0 points ("),
              0u)
        << words[1];
    EXPECT_EQ(words[2], "What is open needs more courses to be decided.");
    EXPECT_EQ(words[3].find("W-RoI with A*: 1 collision in 1 run ("), 0u) << words[3];
    EXPECT_EQ(words[4], "G-Full with A*: no collision in 1 run.");
    EXPECT_THAT(words[5], HasSubstr("0 collisions in 1 run of a scenario still allows"));
}

TEST(Verdict, CallsNothingWorseThatMayBeChance) {
    // The interval excludes 3 points, but among so many comparisons the test does not.
    reports::Pairing pairing{"", kReference, {"W-RoI", "astar"}, {"G-Full", "astar"}};
    pairing.both = 90;
    pairing.only_second = 10;
    pairing.difference = -0.1;
    pairing.interval = {-0.17, -0.04};
    pairing.verdict = reports::Verdict::Inferior;
    pairing.p_holm = 0.06;
    EXPECT_EQ(reports::differenceText(pairing).find("Open: "), 0u);
    EXPECT_THAT(reports::differenceText(pairing), HasSubstr("may be chance"));
    pairing.p_holm = 0.04;
    EXPECT_EQ(reports::differenceText(pairing).find(
                  "W-RoI with A* against G-Full: success 90.0 % against 100.0 %"),
              0u);
}

TEST(Verdict, TellsLossesThatGoUnderInTheWhole) {
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
    EXPECT_EQ(words[0],
              "W-RoI with A* at 4 m/s: nothing is decided yet. But it arrives less often than "
              "G-Full (in movers). Open: G-Full.");
    EXPECT_EQ(words[1].find("Open: W-RoI with A* against G-Full: success 90.0 % against 89.0 %"),
              0u)
        << words[1];
    EXPECT_EQ(words[2].find("In movers, W-RoI with A* against G-Full: success 80.0 % against "
                            "100.0 % of the same 100 courses, -20.0 points"),
              0u)
        << words[2];
    EXPECT_EQ(words[3], "What is open needs more courses to be decided.");
}

/// 45 of 200 lost in one of ten scenarios are no 3 points of the whole.
TEST(Verdict, TellsLossesThatGoUnderAmongWiresAndBelowAVerdict) {
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
              "W-RoI with A* at 4 m/s, on the whole, arrives less often than G-Full, by less than "
              "3 points. But it arrives less often than G-Full (among wires).");
    EXPECT_EQ(words[2].find("Among wires, W-RoI with A* against G-Full: success 77.5 %"), 0u)
        << words[2];
}

TEST(Verdict, TellsOfOneScenarioOnce) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        runs.push_back(test::runOf("gap", seed, "W-RoI", "astar", seed < 5 ? kHit : kWon));
        runs.push_back(test::runOf("gap", seed, "G-Full", "astar", kWon));
    }
    const std::vector<std::string> words = reports::verdictOf(reports::summarize(runs));
    EXPECT_EQ(words[1].find("Open: W-RoI with A* against G-Full"), 0u) << words[1];
    EXPECT_EQ(words[2], "What is open needs more courses to be decided.");
}

TEST(Verdict, SaysWhereWhatWasNotFlownEverywhere) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        for (const char* scenario : {"gap", "u-trap"}) {
            runs.push_back(test::runOf(scenario, seed, "W-RoI", "astar", kWon));
            runs.push_back(test::runOf(scenario, seed, "G-Full", "astar", kWon));
        }
        runs.push_back(test::runOf("gap", seed, "O-Full-0.4", "astar", kWon));
    }
    const std::string headline = reports::verdictOf(reports::summarize(runs)).front();
    EXPECT_THAT(headline, HasSubstr("O-Full-0.4 (in gap)"));
    EXPECT_THAT(headline, Not(HasSubstr("G-Full (")));
}

}  // namespace
}  // namespace hagen
