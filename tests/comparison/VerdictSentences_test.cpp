// Every sentence that the verdict can say, from a made-up table with a known answer, and from one
// with another answer, which must not say it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <hagen/reports/Answer.h>
#include <hagen/reports/Report.h>
#include <hagen/reports/ReportSentences.h>
#include <hagen/reports/Saturation.h>
#include <hagen/reports/Summary.h>
#include <hagen/reports/SummaryFiles.h>
#include <hagen/reports/Verdict.h>
#include <functional>
#include "SampleRuns.h"

namespace hagen {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using namespace test;

/// How often two contenders succeeded on the same courses.
struct Counts {
    int both, only_first, only_second, neither;
};

/// The flights of `model` and of its rival through one scenario, with these outcomes.
struct Table {
    std::vector<Row> runs;

    Table& add(const std::string& scenario, const std::string& rival, Counts counts,
               double speed_m_s = 4, const std::string& model = "W-RoI",
               const std::string& guidance = "astar",
               const std::string& rivals_guidance = "astar") {
        const int n = counts.both + counts.only_first + counts.only_second + counts.neither;
        for (int i = 0; i < n; ++i) {
            const bool first = i < counts.both + counts.only_first;
            const bool second =
                i < counts.both || (i >= counts.both + counts.only_first && i < n - counts.neither);
            const auto seed = static_cast<std::uint64_t>(i);
            runs.push_back(
                test::runOf(scenario, seed, model, guidance, first ? kWon : kLate, speed_m_s));
            runs.push_back(test::runOf(scenario, seed, rival, rivals_guidance,
                                       second ? kWon : kLate, speed_m_s));
        }
        return *this;
    }
    std::vector<std::string> verdict() const {
        return reports::verdictOf(reports::summarize(runs));
    }
    std::string first() const { return verdict().front(); }
};

std::string firstOf(Counts counts) { return Table{}.add("gap", "G-Full", counts).first(); }

const std::string kGap = "In gap at 4 m/s, RoI window with A*";

TEST(ScenarioSentence, SaysMoreOftenOnlyIfIntervalAndTestDo) {
    // Six courses on one side: p = 2 / 2^6.
    EXPECT_THAT(firstOf({14, 6, 0, 0}),
                AllOf(StartsWith(kGap + " succeeds more often than occupancy grid 0.2 m (100.0 % "
                                        "vs. 70.0 % of 20 courses; +30.0 points, "),
                      HasSubstr("; p 0.031).")));
    EXPECT_THAT(firstOf({15, 5, 0, 0}), Not(HasSubstr("more often")));  // p = 2 / 2^5
    EXPECT_THAT(firstOf({14, 0, 6, 0}), Not(HasSubstr("more often")));
}

TEST(ScenarioSentence, SaysHowMuchLessOften) {
    EXPECT_THAT(firstOf({80, 0, 20, 0}),
                StartsWith(kGap + " succeeds less often, by more than 3 points, than occupancy "
                                  "grid 0.2 m (80.0 % vs. 100.0 % of 100 courses; -20.0 points, "));
    EXPECT_THAT(firstOf({192, 0, 8, 0}),
                StartsWith(kGap + " succeeds less often, whether by more than 3 points is "
                                  "undecided, than occupancy grid 0.2 m (96.0 % vs. 100.0 % of "));
    EXPECT_THAT(firstOf({1900, 0, 20, 80}),
                StartsWith(kGap + " succeeds less often, by less than 3 points, than occupancy "
                                  "grid 0.2 m (95.0 % vs. 96.0 % of 2000 courses; -1.0 points, "));
    EXPECT_THAT(firstOf({80, 20, 0, 0}), Not(HasSubstr("less often")));
}

/// A decided difference is told although both are at the ceiling.
TEST(ScenarioSentence, TellsADecidedDifferenceAtTheCeiling) {
    EXPECT_THAT(firstOf({1980, 0, 20, 0}), HasSubstr("less often, by less than 3 points, than"));
}

TEST(ScenarioSentence, SaysNotInferiorOnlyWhereNotSaturated) {
    EXPECT_THAT(firstOf({380, 3, 3, 14}),
                StartsWith(kGap + " is not inferior, with a margin of 3 points, to occupancy grid "
                                  "0.2 m (95.8 % vs. 95.8 % of 400 courses; 0.0 points, "));
    // The same interval where both are at the ceiling, and where they differ on no course.
    for (const Counts counts : {Counts{397, 3, 0, 0}, Counts{380, 0, 0, 20}}) {
        for (const std::string& sentence : Table{}.add("gap", "G-Full", counts).verdict()) {
            EXPECT_THAT(sentence, Not(HasSubstr("not inferior")));
        }
    }
}

TEST(ScenarioSentence, SaysMayBeChanceOnlyIfTheIntervalContainsZero) {
    EXPECT_EQ(
        firstOf({20, 4, 5, 11}),
        kGap + ": no comparison is decided yet. Undecided, may be chance: occupancy grid 0.2 m.");
    // 8 to 1, p = 20 / 2^9: significant alone, not as one of three.
    Table three;
    for (const char* scenario : {"gap", "orchard", "street"}) {
        three.add(scenario, "G-Full", {91, 1, 8, 0});
    }
    EXPECT_THAT(
        three.first(),
        AllOf(
            StartsWith(kGap + ": no comparison is decided yet. Undecided: occupancy grid 0.2 m ("),
            HasSubstr("; p 0.117; the interval excludes a difference of zero, the corrected test "
                      "does not)."),
            Not(HasSubstr("chance"))));
    EXPECT_THAT(firstOf({91, 1, 8, 0}),
                AllOf(HasSubstr("less often, whether"), HasSubstr("; p 0.039)")));
}

TEST(ScenarioSentence, SaysIfTooFewCoursesDifferForATest) {
    EXPECT_THAT(firstOf({50, 0, 5, 5}),
                AllOf(HasSubstr("; 5 courses differ, too few for a test; the interval excludes a "
                                "difference of zero, the corrected test does not)"),
                      Not(HasSubstr("; p "))));
    EXPECT_THAT(firstOf({50, 0, 6, 4}), AllOf(HasSubstr("; p 0.031"), Not(HasSubstr("too few"))));
}

TEST(ScenarioSentence, GroupsTheRivalsOfAScenario) {
    Table table;
    table.add("gap", "G-Full", {60, 0, 0, 40}).add("gap", "W-Full", {60, 0, 0, 40});
    table.add("gap", "O-Full-0.4", {40, 20, 0, 40});
    EXPECT_THAT(table.first(),
                AllOf(StartsWith(kGap + " succeeds more often than OctoMap 0.4 m (60.0 % vs. "
                                        "40.0 % of 100 courses; +20.0 points, "),
                      testing::EndsWith(" Saturated: occupancy grid 0.2 m and full window.")));
}

TEST(SaturationSentence, NamesWhatIsSaturatedAndTheSpeedAtWhichItIsNot) {
    Table table;
    table.add("forest-0.05", "G-Full", {100, 0, 0, 0});
    table.add("forest-0.05", "G-Full", {99, 1, 0, 0}, 6);  // both at 99 %
    table.add("forest-0.05", "G-Full", {70, 0, 20, 10}, 10);
    table.add("forest-0.05", "G-Full", {80, 0, 10, 10}, 8);
    table.add("orchard", "G-Full", {100, 0, 0, 0}).add("orchard", "G-Full", {50, 0, 0, 0}, 6);
    table.add("street", "G-Full", {0, 0, 0, 100});  // too hard
    table.add("wires", "G-Full", {98, 0, 2, 0});    // the first is below 99 %
    const std::vector<std::string> verdict = table.verdict();
    EXPECT_THAT(verdict[0], StartsWith("On wires at 4 m/s, "));
    EXPECT_EQ(verdict[1],
              "At 4 m/s, for RoI window with A*, 3 of 4 scenarios are saturated: forest-0.05, "
              "orchard and street. Not saturated: forest-0.05 at 8 m/s. Saturated at every speed "
              "flown: orchard. Flown at no other speed: street.");
    EXPECT_THAT(verdict[2], StartsWith("In forest-0.05 at 8 m/s, RoI window with A* succeeds less "
                                       "often, by more than 3 points, than"));
    EXPECT_THAT(verdict, Not(Contains(HasSubstr("In orchard"))));
    EXPECT_THAT(verdict, Not(Contains(HasSubstr("In forest-0.05 at 4 m/s"))));
}

TEST(SaturationSentence, SaysIfNoneIs) {
    EXPECT_THAT(Table{}.add("gap", "G-Full", {80, 0, 20, 0}).verdict()[1],
                testing::StrEq("At 4 m/s, for RoI window with A*, the only scenario is not "
                               "saturated."));
    EXPECT_EQ(firstOf({80, 0, 0, 20}),
              "At 4 m/s, for RoI window with A*, the only scenario is saturated: gap. Flown at no "
              "other speed: gap.");
}

TEST(SaturationSentence, NeedsEveryRivalToBeSaturated) {
    Table table;
    table.add("gap", "G-Full", {60, 0, 0, 40}).add("gap", "W-Full", {58, 2, 0, 40});
    const std::vector<reports::Saturation> all =
        reports::saturationsOf(reports::summarize(table.runs));
    ASSERT_EQ(all.size(), 1u);
    EXPECT_FALSE(all[0].is_saturated);
    EXPECT_EQ(all[0].comparisons, 2);
    EXPECT_EQ(all[0].alike, 1);
    EXPECT_EQ(reports::unsaturated(all, all[0])->condition.speed_m_s, 4);
}

/// The guidance makes a difference where the models make none.
TEST(GuidanceSentence, IsApartFromTheModels) {
    Table table;
    table.add("u-trap", "W-Full", {100, 0, 0, 0});
    table.add("u-trap", "W-RoI", {0, 100, 0, 0}, 4, "W-RoI", "astar", "straight");
    const std::vector<std::string> verdict = table.verdict();
    EXPECT_THAT(verdict[0], HasSubstr("the only scenario is saturated: u-trap."));
    EXPECT_THAT(verdict[1],
                StartsWith("In u-trap at 4 m/s, RoI window with A* succeeds more often than RoI "
                           "window with straight guidance (100.0 % vs. 0.0 % of 100 courses"));
    table.add("gap", "W-Full", {80, 0, 20, 0});
    table.add("gap", "W-RoI", {0, 80, 0, 20}, 4, "W-RoI", "astar", "straight");
    EXPECT_THAT(table.first(), AllOf(HasSubstr("than full window ("), Not(HasSubstr("straight"))));
    table = Table{};
    table.add("u-trap", "W-RoI", {100, 0, 0, 0}, 4, "W-RoI", "astar", "straight");
    EXPECT_EQ(
        table.first(),
        "In u-trap at 4 m/s, RoI window with A*: nothing to tell apart. Saturated: RoI window "
        "with straight guidance.");
}

TEST(LeftOutSentence, CountsWhatCouldNotBeSignificant) {
    const auto sentence = [](const Table& table) {
        return reports::leftOutSentence(reports::summarize(table.runs).pairings, "of these");
    };
    Table table;
    table.add("gap", "G-Full", {90, 0, 5, 5});
    table.add("orchard", "G-Full", {90, 0, 0, 10});
    table.add("street", "G-Full", {90, 3, 3, 4});
    EXPECT_EQ(sentence(table),
              "2 of 3 comparisons of these could not be significant, because fewer than 6 courses "
              "differ, and are left out of the correction.");
    EXPECT_THAT(table.verdict(),
                Contains(AllOf(StartsWith("2 of 3 comparisons in single scenarios could not be "),
                               testing::EndsWith(" No comparison over all scenarios is left out "
                                                 "of the correction."))));
    EXPECT_EQ(sentence(Table{}.add("gap", "G-Full", {90, 2, 3, 5})),
              "1 of 1 comparison of these could not be significant, because fewer than 6 courses "
              "differ, and is left out of the correction.");
    EXPECT_EQ(sentence(Table{}.add("gap", "G-Full", {90, 3, 3, 4})),
              "No comparison of these is left out of the correction.");
}

/// What is left out does not make the others harder to find.
TEST(LeftOutSentence, IsTrueOfTheCorrection) {
    Table table;
    table.add("gap", "G-Full", {90, 0, 6, 4});
    for (const char* scenario : {"orchard", "street", "terrain"}) {
        table.add(scenario, "G-Full", {90, 0, 5, 5});
    }
    const reports::Summary summary = reports::summarize(table.runs);
    for (const reports::Pairing& pairing : summary.pairings) {
        if (pairing.scenario == "gap") {
            EXPECT_NEAR(pairing.p_holm, 2.0 / 64, 1e-12);
        } else {
            EXPECT_TRUE(std::isnan(pairing.p_holm));
            EXPECT_NEAR(pairing.least_p, 2.0 / 32, 1e-12);
        }
    }
    const std::string json = reports::summaryJson(summary, {});
    EXPECT_THAT(json, HasSubstr("\"least_p\": 0.0625,"));
    EXPECT_THAT(json, HasSubstr("\"p_holm\": null"));
}

const std::string kPooled =
    "ver all scenarios at 4 m/s, RoI window with A* vs. occupancy grid 0.2 m: success ";

TEST(PooledSentence, SaysNotInferiorOnlyWithTheScenariosWithoutADifference) {
    Table table;
    table.add("gap", "G-Full", {380, 3, 3, 14});
    EXPECT_THAT(table.verdict(), Not(Contains(HasSubstr(kPooled))));  // one scenario is no total
    table.add("orchard", "G-Full", {400, 0, 0, 0}).add("street", "G-Full", {400, 0, 0, 0});
    EXPECT_THAT(
        table.verdict(),
        Contains(AllOf(
            StartsWith("O" + kPooled + "98.6 % vs. 98.6 % on the same 1200 courses, 0.0 points ("),
            HasSubstr(
                "; Holm-corrected p 1.000). 2 of 3 scenarios have no course on which the two "
                "differ. Not inferior in total: the interval excludes a loss of 3 points."))));
    table = Table{};
    table.add("gap", "G-Full", {380, 3, 3, 14}).add("street", "G-Full", {380, 3, 3, 14});
    EXPECT_THAT(table.verdict(), Contains(AllOf(HasSubstr("). In each of the 2 scenarios there are "
                                                          "courses on which the two differ. Not "
                                                          "inferior in total"))));
}

TEST(PooledSentence, ComesAfterTheScenarios) {
    Table table;
    table.add("gap", "G-Full", {80, 0, 20, 0}).add("street", "G-Full", {80, 0, 20, 0});
    const std::vector<std::string> verdict = table.verdict();
    EXPECT_THAT(verdict[0], StartsWith("In gap at 4 m/s"));
    EXPECT_THAT(verdict[1], StartsWith("In street at 4 m/s"));
    const auto pooled = std::find_if(verdict.begin(), verdict.end(), [](const std::string& text) {
        return text.find(kPooled) != std::string::npos;
    });
    ASSERT_NE(pooled, verdict.end());
    EXPECT_THAT(*pooled, AllOf(HasSubstr("80.0 % vs. 100.0 %"), Not(HasSubstr("nferior"))));
}

TEST(PooledSentence, SaysWhatIsUndecidedAndWhy) {
    Table table;
    table.add("gap", "G-Full", {20, 4, 5, 11}).add("street", "G-Full", {40, 0, 0, 0});
    EXPECT_THAT(table.verdict(),
                Contains(AllOf(StartsWith("Undecided: O" + kPooled),
                               HasSubstr("1 of 2 scenarios has no course"),
                               HasSubstr("The interval contains zero, so the difference may be "
                                         "chance."))));
    table = Table{};
    table.add("gap", "G-Full", {45, 0, 5, 0}).add("street", "G-Full", {50, 0, 0, 0});
    EXPECT_THAT(
        table.verdict(),
        Contains(AllOf(StartsWith("Undecided: O" + kPooled),
                       HasSubstr("; 5 courses differ, too few for a test)."),
                       HasSubstr(" The interval excludes a difference of zero, the corrected test "
                                 "does not."),
                       Not(HasSubstr("chance")))));
}

TEST(PooledSentence, SaysIfEverythingIsSaturated) {
    Table table;
    table.add("gap", "G-Full", {200, 0, 0, 0}).add("street", "G-Full", {200, 0, 0, 0});
    EXPECT_THAT(table.verdict(),
                Contains(AllOf(HasSubstr("2 of 2 scenarios have no course on which the two differ. "
                                         "Saturated: they differ on no course."),
                               Not(HasSubstr("inferior")))));
    table.add("orchard", "G-Full", {199, 1, 0, 0});
    EXPECT_THAT(
        table.verdict(),
        Contains(AllOf(HasSubstr("2 of 3 scenarios have no course on which the two differ. "
                                 "Saturated: both succeed on at least 99 % of the courses."),
                       Not(HasSubstr("inferior")))));
}

TEST(DifferenceText, SaysIfTheTestExcludesZeroAndTheIntervalDoesNot) {
    reports::Pairing pairing{"gap", kReference, {"W-RoI", "astar"}, {"G-Full", "astar"}};
    pairing.both = 90;
    pairing.only_second = 10;
    pairing.interval = {-0.17, 0.01};
    pairing.p_holm = 0.04;
    EXPECT_THAT(reports::differenceText(pairing),
                AllOf(StartsWith("Undecided: In gap"),
                      HasSubstr("The corrected test excludes a difference of zero, the interval "
                                "does not."),
                      Not(HasSubstr("chance"))));
    EXPECT_EQ(reports::answerOf(pairing), reports::Answer::Undecided);
    pairing.p_holm = 0.06;
    EXPECT_THAT(reports::differenceText(pairing), HasSubstr("may be chance"));
}

TEST(UndecidedSentence, IsThereOnlyIfSomethingIs) {
    const std::string sentence = "Undecided comparisons need more courses.";
    EXPECT_THAT(Table{}.add("gap", "G-Full", {20, 4, 5, 11}).verdict(), Contains(sentence));
    EXPECT_THAT(Table{}.add("gap", "G-Full", {80, 0, 20, 0}).verdict(), Not(Contains(sentence)));
    EXPECT_THAT(Table{}.add("gap", "G-Full", {80, 0, 0, 20}).verdict(), Not(Contains(sentence)));
}

/// 100 courses: the true scene fails on 10, the RoI window on these and 30 more, the full window on
/// the same 10 only, the grid on 5 more, the OctoMap on none.
Table flownByTheTrueScene() {
    Table table;
    table.add("gap", "oracle", {60, 0, 30, 10});
    table.add("gap", "oracle", {90, 0, 0, 10}, 4, "W-Full");
    table.add("gap", "oracle", {85, 0, 5, 10}, 4, "G-Full");
    table.add("gap", "oracle", {90, 10, 0, 0}, 4, "O-Full-0.4");
    return table;
}

TEST(OracleSentence, SeparatesThePlannersCeilingFromTheModelsLoss) {
    EXPECT_THAT(
        flownByTheTrueScene().verdict(),
        Contains(AllOf(
            StartsWith("In gap at 4 m/s, the true scene with A* succeeds on 90.0 % of 100 "
                       "courses: the other 10.0 points are lost by planner and guidance, "
                       "which take the world to stand still. The model "
                       "loses more: RoI window (60.0 % vs. 90.0 % of 100 courses; -30.0 points, "),
            HasSubstr(". Better than the true scene: OctoMap 0.4 m (100.0 % vs. 90.0 % of 100 "
                      "courses; +10.0 points, "),
            HasSubstr(". Undecided: occupancy grid 0.2 m (85.0 % vs. 90.0 % of 100 courses; -5.0 "
                      "points, "),
            HasSubstr("; 5 courses differ, too few for a test; the interval excludes a "),
            HasSubstr(" No gap: full window (90.0 % vs. 90.0 % of 100 courses, none of which "
                      "differs)."))));
}

TEST(OracleSentence, SaysWhatIsOpenOrWithinTheMargin) {
    Table table;
    table.add("gap", "oracle", {20, 4, 5, 11});
    EXPECT_THAT(table.verdict(),
                Contains(HasSubstr("still. Undecided, may be chance: RoI window (60.0 % vs.")));
    table = Table{}.add("gap", "oracle", {394, 0, 6, 0});
    EXPECT_THAT(table.verdict(),
                Contains(HasSubstr("succeeds on all 400 courses: planner and guidance lose none. "
                                   "The model loses more: RoI window (98.5 % vs. 100.0 % of ")));
    table = Table{}.add("gap", "oracle", {380, 3, 3, 14});
    EXPECT_THAT(table.verdict(),
                Contains(HasSubstr("Not inferior to the true scene, with a margin of 3 points: "
                                   "RoI window (")));
}

TEST(OracleSentence, NamesTheScenariosWithoutAGap) {
    Table table;
    table.add("gap", "oracle", {80, 0, 0, 20}).add("orchard", "oracle", {100, 0, 0, 0});
    table.add("street", "oracle", {80, 0, 20, 0});
    EXPECT_THAT(table.verdict(), Contains("At 4 m/s with A*, no model differs from the true scene "
                                          "on any course of gap and orchard."));
    EXPECT_THAT(table.verdict(), Contains(StartsWith("In street at 4 m/s, the true scene with A* "
                                                     "succeeds on all 100 courses")));
    // Nobody flew it.
    for (const std::string& sentence : Table{}.add("gap", "G-Full", {80, 0, 0, 20}).verdict()) {
        EXPECT_THAT(sentence, Not(HasSubstr("true scene")));
    }
}

TEST(OracleSentence, CallsNoGapWhatIsOnlyNearTheCeiling) {
    Table table;
    table.add("gap", "oracle", {198, 0, 2, 0}).add("street", "oracle", {80, 0, 20, 0});
    EXPECT_THAT(table.verdict(),
                Contains("At 4 m/s with A*, all comparisons with the true scene are saturated in "
                         "gap: both succeed on at least 99 %, or differ on no course."));
    EXPECT_THAT(table.verdict(), Not(Contains(HasSubstr("no model differs"))));
}

TEST(OracleSentence, SaysWhatMotionIsWorthIfItFlewTheSameCourses) {
    const auto tableWith = [](int courses_with_motion) {
        Table table;
        table.add("gap", "oracle", {50, 0, 10, 40});
        for (int i = 0; i < courses_with_motion; ++i) {
            table.runs.push_back(test::runOf("gap", static_cast<std::uint64_t>(i), "oracle+motion",
                                             "astar", i < 95 ? kWon : kLate));
        }
        return table;
    };
    EXPECT_THAT(
        tableWith(100).verdict(),
        Contains(StartsWith("In gap at 4 m/s, the true scene with A* succeeds on 60.0 % of "
                            "100 courses: the other 40.0 points are lost by planner and "
                            "guidance. Where it is known how obstacles move, they succeed "
                            "on 95.0 % of the same courses: that is worth +35.0 points, and "
                            "5.0 points are lost all the same. ")));
    for (const int courses : {0, 99}) {
        EXPECT_THAT(tableWith(courses).verdict(),
                    Contains(HasSubstr("guidance, which take the world to stand still.")));
    }
}

/// The same contest unbiased or in dusty air, and the other way.
Table flownBothWays(Counts usual, Counts other, const std::function<void(Row&)>& change) {
    Table table = Table{}.add("gap", "G-Full", usual), second = Table{}.add("gap", "G-Full", other);
    for (Row& run : second.runs) change(run);
    table.runs.insert(table.runs.end(), second.runs.begin(), second.runs.end());
    return table;
}

const auto kAsStored = [](Row& run) { run.setup.distance = trials::ModelDistance::AsStored; };
const auto kClearAir = [](Row& run) { run.setup.air = trials::Air::Clear; };

TEST(SensitivitySentence, AnAnswerThatFlipsIsOpen) {
    EXPECT_THAT(
        flownBothWays({60, 30, 0, 10}, {60, 0, 30, 10}, kAsStored).verdict(),
        AllOf(
            Contains(AllOf(StartsWith("Open: in gap at 4 m/s, RoI window with A* vs. occupancy "
                                      "grid 0.2 m. With unbiased distances it succeeds more "
                                      "often (90.0 % vs. 60.0 % of 100 courses; +30.0 points, "),
                           HasSubstr("), with distances as stored it succeeds less often (60.0 % "
                                     "vs. 90.0 % of 100 courses; -30.0 points, "))),
            Contains("Of 1 comparison flown with unbiased distances and with distances as stored, "
                     "1 has the opposite answer and is open.")));
    // Not inferior, and less often.
    EXPECT_THAT(flownBothWays({380, 3, 3, 14}, {60, 0, 30, 10}, kClearAir).verdict(),
                Contains(AllOf(StartsWith("Open: in gap"),
                               HasSubstr("In dusty air it is not "
                                         "inferior ("),
                               HasSubstr("), in clear air it succeeds less often ("))));
}

TEST(SensitivitySentence, AnAnswerThatDoesNotFlipIsCounted) {
    const std::string counted =
        "Of 1 comparison flown in dusty air and in clear air, none has the opposite answer, 1 ";
    const auto verdictOf = [](Counts usual, Counts other) {
        return flownBothWays(usual, other, kClearAir).verdict();
    };
    const Counts better{60, 30, 0, 10}, open{50, 5, 5, 40}, slightly_worse{1900, 0, 20, 80},
        not_inferior{380, 3, 3, 14};
    EXPECT_THAT(verdictOf(better, better),
                Contains(counted + "decided in both without a contradiction."));
    EXPECT_THAT(verdictOf(better, not_inferior),
                Contains(counted + "decided in both without a contradiction."));
    EXPECT_THAT(verdictOf(slightly_worse, not_inferior),
                Contains(counted + "decided in both without a contradiction."));
    // Whether the loss is more than the margin is open.
    EXPECT_THAT(verdictOf(not_inferior, {170, 0, 8, 22}),
                Contains(counted + "decided in both without a contradiction."));
    EXPECT_THAT(verdictOf(better, open), Contains(counted + "decided only in dusty air."));
    EXPECT_THAT(verdictOf(open, better), Contains(counted + "decided only in clear air."));
    EXPECT_THAT(verdictOf(open, open), Contains(counted + "decided neither way."));
    for (const std::string& sentence : verdictOf(better, better)) {
        EXPECT_THAT(sentence, Not(HasSubstr("Open: ")));
    }
}

TEST(SensitivitySentence, OnlyTheSameContestCounts) {
    // At another speed, and with another planner.
    for (const std::function<void(Row&)>& change : {std::function<void(Row&)>([](Row& run) {
                                                        kAsStored(run);
                                                        run.setup.speed_m_s = 6;
                                                    }),
                                                    std::function<void(Row&)>([](Row& run) {
                                                        kAsStored(run);
                                                        run.setup.planner = "3dvfh";
                                                    })}) {
        for (const std::string& sentence :
             flownBothWays({60, 30, 0, 10}, {60, 0, 30, 10}, change).verdict()) {
            EXPECT_THAT(sentence, Not(HasSubstr("opposite")));
        }
    }
    for (const std::string& sentence : Table{}.add("gap", "G-Full", {60, 30, 0, 10}).verdict()) {
        EXPECT_THAT(sentence, Not(HasSubstr("flown with")));
    }
}

TEST(Oracle, IsACeilingAndNoRival) {
    Table table = flownByTheTrueScene();
    table.add("gap", "oracle", {0, 0, 60, 40}, 4, "W-RoI", "straight", "straight");
    const reports::Summary summary = reports::summarize(table.runs);
    EXPECT_EQ(summary.to_oracle.size(), 5u);
    for (const std::vector<reports::Pairing>* list : {&summary.pairings, &summary.overall}) {
        for (const reports::Pairing& pairing : *list) EXPECT_NE(pairing.second.model, "oracle");
    }
    for (const std::string& sentence : table.verdict()) {
        EXPECT_THAT(sentence, Not(HasSubstr("than true scene")));
    }
    EXPECT_THAT(table.verdict(),
                Contains(AllOf(StartsWith("In gap at 4 m/s, the true scene with straight guidance "
                                          "succeeds on 60.0 % of 100 courses: the other 40.0 "
                                          "points are lost by planner and guidance, "
                                          "which take the world to stand still. The model "
                                          "loses more: RoI window (0.0 % vs. 60.0 % of 100 "),
                               Not(HasSubstr("full window")))));
}

// At other speeds there are many such sentences: they are with their tables.
TEST(Oracle, SentencesAtOtherSpeedsAreWithTheirTable) {
    Table table = flownByTheTrueScene();
    table.add("wires", "oracle", {50, 0, 30, 20}, 6);
    const char* const sentence = "On wires at 6 m/s, the true scene with A* succeeds on 80.0 % of ";
    EXPECT_THAT(table.verdict(),
                testing::Each(Not(HasSubstr("true scene with A* succeeds on 80"))));
    EXPECT_THAT(table.verdict(), Contains(HasSubstr("In gap at 4 m/s, the true scene with A* ")));
    reports::Report report;
    report.flown.runs = table.runs;
    report.summary = reports::summarize(table.runs);
    const std::string text = reports::reportMarkdown(report);
    const std::size_t section = text.find("\n## Gap to the true scene\n");
    ASSERT_NE(section, std::string::npos);
    const std::size_t at = text.find(sentence);
    EXPECT_GT(at, section);
    EXPECT_LT(at, text.find("\n## ", section + 1));
}

TEST(Oracle, IsInEveryTableOfSuccessAndCollision) {
    Table table = flownByTheTrueScene();
    table.add("wires", "oracle", {60, 0, 30, 10});
    table.add("wires", "W-RoI", {60, 0, 0, 40}, 4, "W-RoI", "astar", "straight");
    table.add("wires", "oracle", {50, 0, 30, 20}, 6);
    reports::Report report;
    report.flown.runs = table.runs;
    report.summary = reports::summarize(table.runs);
    const std::string page = reports::reportPage(report), text = reports::reportMarkdown(report);
    int tables = 0;
    for (std::size_t at = 0; (at = text.find("\n## ", at)) != std::string::npos; ++at) {
        const std::string section = text.substr(at + 1, text.find("\n## ", at + 1) - at);
        const std::string title = section.substr(0, section.find('\n'));
        const bool is_rate = title.find("Success") != std::string::npos ||
                             title.find("Collisions at") != std::string::npos ||
                             title.find("wires") != std::string::npos ||
                             title.find("World model by guidance") != std::string::npos;
        if (!is_rate) continue;
        EXPECT_THAT(section, HasSubstr("true scene")) << title;
        ++tables;
    }
    EXPECT_EQ(tables, 6);  // success at two speeds, collisions, wires, guidance, highest speed
    EXPECT_THAT(text, HasSubstr("| wires | true scene | 90.0 (82.6 to 94.5; 100) |  |"));
    EXPECT_THAT(text, HasSubstr("\n## Gap to the true scene\n"));
    EXPECT_THAT(text, HasSubstr("comparisons with the true scene could not be significant"));
    EXPECT_THAT(page, HasSubstr("<td>true scene, A*</td>"));
    EXPECT_THAT(table.verdict(), Contains("True scene with A*: no collision in 200 runs."));
}

TEST(Tables, ShowWhatIsSaturated) {
    Table table;
    table.add("gap", "G-Full", {80, 0, 10, 10}).add("orchard", "G-Full", {100, 0, 0, 0});
    table.add("orchard", "G-Full", {80, 3, 10, 7}, 8).add("street", "G-Full", {100, 0, 0, 0});
    reports::Report report;
    report.summary = reports::summarize(table.runs);
    const std::string text = reports::reportMarkdown(report);
    for (const char* row : {
             "| gap | RoI window, A* | 1 model | 0 | differs | 4 m/s |\n",
             "| orchard | RoI window, A* | 1 model | 1 | saturated | 8 m/s |\n",
             "| street | RoI window, A* | 1 model | 1 | saturated | no speed flown |\n",
             // a total, with the scenarios without a difference
             "| all | 4 m/s | RoI window, A* | occupancy grid 0.2 m, A* | 300 | 2 of 3 | 0 | 10 |",
             "\nAt 8 m/s, for RoI window with A*, the only scenario is not saturated.\n",
         }) {
        EXPECT_THAT(text, HasSubstr(row));
    }
    // Single comparisons only where there is a difference; all of them on the page.
    const std::string saturated = "orchard | 4 m/s | RoI window, A* | occupancy grid 0.2 m, A* | ";
    EXPECT_THAT(text, Not(HasSubstr(saturated)));
    EXPECT_THAT(text,
                HasSubstr("| orchard | 8 m/s | RoI window, A* | occupancy grid 0.2 m, A* | "));
    EXPECT_THAT(reports::reportPage(report),
                HasSubstr("Paired comparisons in each scenario, with those that are saturated"));
    const std::string json = reports::summaryJson(report.summary, {});
    EXPECT_THAT(json, HasSubstr("\"scenarios_without_difference\": 2"));
    EXPECT_THAT(json, HasSubstr("\"saturated\": true"));
    table = Table{}.add("gap", "G-Full", {100, 0, 0, 0});
    report.summary = reports::summarize(table.runs);
    EXPECT_THAT(reports::reportMarkdown(report),
                AllOf(HasSubstr("\nAll are saturated.\n"), HasSubstr(" | - | saturated | ")));
}

TEST(Tables, OfASingleModelSayThatThereIsNothingToCompare) {
    reports::Report report;
    report.summary = reports::summarize({test::runOf("gap", 0, "W-RoI", "astar", kWon)});
    const std::string text = reports::reportMarkdown(report);
    EXPECT_THAT(text, HasSubstr("No two models to compare flew the same course."));
    EXPECT_THAT(text, Not(HasSubstr("aturated")));
    report.summary = reports::summarize(Table{}.add("gap", "oracle", {60, 0, 30, 10}).runs);
    EXPECT_THAT(reports::reportMarkdown(report),
                AllOf(HasSubstr("No two models"), HasSubstr("\n## Gap to the true scene\n")));
}

TEST(LossesSentence, CountsChanceByTheInterval) {
    Table table;
    table.add("gap", "G-Full", {60, 0, 40, 0});     // both exclude zero
    table.add("movers", "G-Full", {80, 1, 8, 11});  // the interval does: p .039 is one of four
    table.add("street", "G-Full", {80, 4, 6, 10});  // neither does
    table.add("terrain", "G-Full", {80, 6, 4, 10});
    EXPECT_EQ(reports::lossesSentence(reports::summarize(table.runs)),
              "Of 4 comparisons in single scenarios, the RoI window succeeds less often in 3. "
              "Interval and corrected test exclude a difference of zero (p < 0.05) in 1 of them, "
              "in 1 the interval does and the corrected test does not; 1 may be chance, the "
              "interval contains zero. Largest loss first.");
    table = Table{}.add("gap", "G-Full", {60, 0, 40, 0});
    EXPECT_EQ(reports::lossesSentence(reports::summarize(table.runs)),
              "Of 1 comparison in single scenarios, the RoI window succeeds less often in 1. "
              "Interval and corrected test exclude a difference of zero (p < 0.05) in 1 of them. "
              "Largest loss first.");
    table = Table{}.add("gap", "G-Full", {60, 40, 0, 0});
    EXPECT_EQ(reports::lossesSentence(reports::summarize(table.runs)),
              "Of 1 comparison in single scenarios, the RoI window succeeds less often in 0.");
}

TEST(CollisionSentence, NamesTheScenarios) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        runs.push_back(test::runOf("gap", seed, "W-RoI", "astar", seed < 3 ? kHit : kWon));
        runs.push_back(test::runOf("street", seed, "W-RoI", "astar", kLate));
        runs.push_back(test::runOf("gap", seed, "G-Full", "astar", kWon));
    }
    const std::vector<std::string> verdict = reports::verdictOf(reports::summarize(runs));
    EXPECT_THAT(verdict, Contains("RoI window with A*: 3 collisions in 8 runs (gap 3 of 4)."));
    EXPECT_THAT(verdict, Contains("Occupancy grid 0.2 m with A*: no collision in 4 runs."));
}

/// Summaries of two sets of runs can be compared by answer.
TEST(Answer, CanBeComparedBetweenPartsOfTheRuns) {
    const reports::Summary a =
        reports::summarize(Table{}.add("gap", "G-Full", {80, 0, 20, 0}).runs);
    const reports::Summary b =
        reports::summarize(Table{}.add("gap", "G-Full", {80, 20, 0, 0}).runs);
    ASSERT_TRUE(reports::isSameContest(a.pairings[0], b.pairings[0]));
    EXPECT_EQ(reports::answerOf(a.pairings[0]), reports::Answer::LessByMargin);
    EXPECT_EQ(reports::answerOf(b.pairings[0]), reports::Answer::MoreOften);
    EXPECT_THAT(reports::summaryJson(a, {}),
                HasSubstr("\"answer\": \"less often, by more than the margin\""));
}

}  // namespace
}  // namespace hagen
