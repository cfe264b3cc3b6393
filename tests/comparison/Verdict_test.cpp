// The sentences of the verdict.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <hagen/reports/Summary.h>
#include <hagen/reports/Verdict.h>
#include "SampleRuns.h"

namespace hagen {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

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
    EXPECT_THAT(words[0],
                StartsWith("On wires at 4 m/s, RoI window with A* succeeds less often, by "
                           "more than 3 points, than full window (75.0 % vs. 100.0 % of "
                           "400 courses; -25.0 points, "));
    // No total with wires, nor one of a single scenario.
    EXPECT_THAT(words, Not(Contains(HasSubstr("vs. full window: success"))));
    const std::vector<reports::Pairing> apart =
        reports::splitByWires(summary, summary.overall.front());
    ASSERT_EQ(apart.size(), 2u);
    EXPECT_THAT(reports::differenceText(apart[0]),
                StartsWith("Without wires at 4 m/s, RoI window with A* vs. full window: success "
                           "100.0 % vs. 99.8 % on the same 400 courses, +0.2 points (95 % "
                           "interval "));
    EXPECT_THAT(reports::differenceText(apart[1]),
                StartsWith("On wires at 4 m/s, RoI window with A* vs. full window: success 75.0 % "
                           "vs. 100.0 %"));
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        runs.push_back(test::runOf("street", seed, "W-RoI", "astar", seed < 20 ? kHit : kWon));
        runs.push_back(test::runOf("street", seed, "W-Full", "astar", seed < 20 ? kHit : kWon));
    }
    EXPECT_THAT(reports::verdictOf(reports::summarize(runs)),
                Contains(AllOf(StartsWith("Without wires at 4 m/s, RoI window with A* vs. full "
                                          "window: success 97.5 % vs. 97.4 % on the same 800 "),
                               HasSubstr("1 of 2 scenarios has no course on which the two "))));
    // Thin wires count as wires, too.
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        runs.push_back(test::runOf("wires-thin", seed, "W-RoI", "astar", kHit));
        runs.push_back(test::runOf("wires-thin", seed, "W-Full", "astar", kWon));
    }
    const reports::Summary more = reports::summarize(runs);
    EXPECT_EQ(more.without_wires[0].pairs(), 800);
    const std::vector<reports::Pairing> three = reports::splitByWires(more, more.overall.front());
    ASSERT_EQ(three.size(), 3u);
    EXPECT_THAT(reports::differenceText(three[2]), StartsWith("On thin wires at 4 m/s, "));
    // If nobody flew wires, the total is already without wires.
    EXPECT_TRUE(reports::summarize({test::runOf("gap", 0, "W-RoI", "astar", kWon),
                                    test::runOf("gap", 0, "W-Full", "astar", kWon)})
                    .without_wires.empty());
}

TEST(Verdict, UsesTheSingular) {
    const std::vector<std::string> words =
        reports::verdictOf(reports::summarize({test::runOf("gap", 0, "W-RoI", "astar", kHit),
                                               test::runOf("gap", 0, "G-Full", "astar", kWon)}));
    ASSERT_EQ(words.size(), 9u);
    EXPECT_THAT(words[0],
                StartsWith("In gap at 4 m/s, RoI window with A*: no comparison is decided "
                           "yet. Undecided, may be chance: occupancy grid 0.2 m."));
    EXPECT_EQ(words[5], "Undecided comparisons need more courses.");
    EXPECT_EQ(words[6].find("RoI window with A*: 1 collision in 1 run ("), 0u) << words[6];
    EXPECT_EQ(words[7], "Occupancy grid 0.2 m with A*: no collision in 1 run.");
    EXPECT_THAT(words[8], HasSubstr("after 0 collisions in 1 run of a scenario, the true"));
}

TEST(Verdict, TheRoiWindowLosesNothingToItself) {
    std::vector<test::Row> runs;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        runs.push_back(test::runOf("gap", seed, "W-RoI", "astar", kHit));
        runs.push_back(test::runOf("gap", seed, "W-RoI", "straight", kWon));
        runs.push_back(test::runOf("gap", seed, "G-Full", "astar", kHit));
    }
    const reports::Summary summary = reports::summarize(runs);
    EXPECT_TRUE(reports::lossesOf(summary).empty());
    EXPECT_THAT(reports::lossesSentence(summary), StartsWith("Of 2 comparisons in single"));
}

TEST(Verdict, CallsNoLossWhatTheCorrectedTestDoesNot) {
    // The interval excludes 3 points, but among so many comparisons the test does not.
    reports::Pairing pairing{"", kReference, {"W-RoI", "astar"}, {"G-Full", "astar"}};
    pairing.both = 90;
    pairing.only_second = 10;
    pairing.difference = -0.1;
    pairing.interval = {-0.17, -0.04};
    pairing.verdict = reports::Verdict::Inferior;
    pairing.p_holm = 0.06;
    EXPECT_THAT(reports::differenceText(pairing), StartsWith("Undecided: At 4 m/s, RoI window "));
    EXPECT_THAT(reports::differenceText(pairing),
                AllOf(HasSubstr("The interval excludes a difference of zero, the corrected test "
                                "does not."),
                      Not(HasSubstr("chance"))));
    pairing.p_holm = 0.04;
    EXPECT_THAT(reports::differenceText(pairing),
                AllOf(StartsWith("At 4 m/s, RoI window with A* vs. occupancy grid 0.2 m: success "
                                 "90.0 % vs. 100.0 %"),
                      Not(HasSubstr("excludes"))));
}

TEST(Verdict, BeginsWithLossesThatTheTotalHides) {
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
    EXPECT_THAT(words[0], StartsWith("In gap at 4 m/s, RoI window with A* succeeds more often than "
                                     "occupancy grid 0.2 m (100.0 % vs. 78.0 %"));
    EXPECT_THAT(words[1], StartsWith("In movers at 4 m/s, RoI window with A* succeeds less often, "
                                     "by more than 3 points, than occupancy grid 0.2 m (80.0 % "
                                     "vs. 100.0 % of 100 courses; -20.0 points"));
    EXPECT_THAT(words, Contains(StartsWith("Undecided: Over all scenarios at 4 m/s, RoI window "
                                           "with A* vs. occupancy grid 0.2 m: success 90.0 % vs. "
                                           "89.0 %")));
    EXPECT_THAT(words, Contains("Undecided comparisons need more courses."));
}

/// 45 of 200 lost in one of ten scenarios are less than 3 points of the total.
TEST(Verdict, BeginsWithLossesOnWiresThatTheTotalHides) {
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
    EXPECT_THAT(words[0],
                StartsWith("On wires at 4 m/s, RoI window with A* succeeds less often, by "
                           "more than 3 points, than occupancy grid 0.2 m (77.5 % "));
    EXPECT_THAT(words[1],
                HasSubstr("9 of 10 scenarios are saturated: a, b, c, d, e, f, g, h and "));
    EXPECT_THAT(words, Contains(HasSubstr("9 of 10 scenarios have no course on which the two ")));
}

TEST(Verdict, ReportsASingleScenarioOnce) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        runs.push_back(test::runOf("gap", seed, "W-RoI", "astar", seed < 5 ? kHit : kWon));
        runs.push_back(test::runOf("gap", seed, "G-Full", "astar", kWon));
    }
    const std::vector<std::string> words = reports::verdictOf(reports::summarize(runs));
    EXPECT_THAT(words[0], HasSubstr("Undecided: occupancy grid 0.2 m ("));
    EXPECT_THAT(words, Not(Contains(HasSubstr("RoI window with A* vs. "))));
}

TEST(Verdict, NamesTheScenariosOfPartialComparisons) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        for (const char* scenario : {"gap", "street", "u-trap"}) {
            runs.push_back(test::runOf(scenario, seed, "W-RoI", "astar", kWon));
            runs.push_back(test::runOf(scenario, seed, "G-Full", "astar", kWon));
        }
        runs.push_back(test::runOf("gap", seed, "O-Full-0.4", "astar", kWon));
        runs.push_back(test::runOf("u-trap", seed, "O-Full-0.4", "astar", kWon));
    }
    const std::vector<std::string> words = reports::verdictOf(reports::summarize(runs));
    EXPECT_THAT(words, Contains(StartsWith("In gap and u-trap at 4 m/s, RoI window with A* vs. "
                                           "OctoMap 0.4 m: ")));
    EXPECT_THAT(words, Contains(StartsWith("Over all scenarios at 4 m/s, RoI window with A* vs. "
                                           "occupancy grid 0.2 m: ")));
}

}  // namespace
}  // namespace hagen
