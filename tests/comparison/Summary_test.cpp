// Counts, spreads and pairs with known answers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <hagen/reports/ReportSentences.h>
#include <hagen/reports/SharedCourses.h>
#include <hagen/reports/Summary.h>
#include <hagen/reports/SummaryFiles.h>
#include <hagen/reports/Verdict.h>
#include <algorithm>
#include "SampleRuns.h"

namespace hagen {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

using namespace test;

TEST(Summary, CountsCellsAndSpreads) {
    const reports::Summary summary = reports::summarize(threeContenders());
    ASSERT_EQ(summary.contenders.size(), 3u);
    EXPECT_EQ(nameOf(summary.contenders[0]), "RoI window, A*");
    const reports::Cell* cell = reports::find(summary, "gap", kReference, {"W-RoI", "astar"});
    ASSERT_NE(cell, nullptr);
    EXPECT_EQ(cell->runs, 10);
    EXPECT_EQ(cell->successes, 9);
    EXPECT_EQ(cell->collisions, 1);
    EXPECT_EQ(cell->timeouts, 0);
    EXPECT_NEAR(cell->min_clearance_m.median, 0.45, 1e-12);  // 0, 0.1, ..., 0.9
    EXPECT_NEAR(cell->path_ratio.median, 44 / 38.5, 1e-12);  // 1.5 m before the goal it ends
    EXPECT_EQ(cell->path_ratio.count, 9);                    // of successful ones alone
    EXPECT_EQ(cell->first_reaction_m.count, 0);
    EXPECT_NEAR(cell->dropped_percent, 5, 1e-12);
    EXPECT_NEAR(cell->stops_per_km, 2 / 0.044, 1e-9);
    EXPECT_EQ(cell->latency_max_ms, 9);
    EXPECT_EQ(reports::find(summary, "gap", kReference, {"W-Full", "astar"}), nullptr);
}

/// 1000 resamples: the interval of another number is another one.
TEST(Summary, AMedianHasTheBootstrapsInterval) {
    std::vector<Row> runs;
    std::vector<double> clearances_m;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        runs.push_back(runOf("gap", seed, "W-RoI", "astar", kWon));
        clearances_m.push_back(std::sqrt(1.0 + static_cast<double>(seed)));
        runs.back().result.min_clearance_m = clearances_m.back();
    }
    const reports::Summary summary = reports::summarize(runs);
    const reports::Cell* cell = reports::find(summary, "gap", kReference, {"W-RoI", "astar"});
    ASSERT_NE(cell, nullptr);
    const trials::Bounds expected = trials::medianInterval(clearances_m, 1000);
    EXPECT_EQ(cell->min_clearance_m.median_interval.low, expected.low);
    EXPECT_EQ(cell->min_clearance_m.median_interval.high, expected.high);
}

TEST(Summary, PairsRunsThroughTheSameCourse) {
    std::vector<Row> runs = threeContenders();
    runs.push_back(test::runOf("gap", 99, "W-RoI", "astar", kWon));  // nobody else flew it
    const reports::Summary summary = reports::summarize(runs);
    // A*: against the map and against itself straight; straight: against the map under A*.
    ASSERT_EQ(summary.pairings.size(), 3u);
    const reports::Pairing* pairing = nullptr;
    for (const reports::Pairing& one : summary.pairings) {
        if (one.first.guidance == "astar" && one.second.model == "O-Full-0.4") pairing = &one;
    }
    ASSERT_NE(pairing, nullptr);
    EXPECT_EQ(pairing->both, 7);
    EXPECT_EQ(pairing->only_first, 2);
    EXPECT_EQ(pairing->only_second, 0);
    EXPECT_EQ(pairing->neither, 1);
    EXPECT_EQ(pairing->only_first_collided, 1);
    EXPECT_NEAR(pairing->difference, 0.2, 1e-12);
    EXPECT_NEAR(pairing->p, 0.5, 1e-12);
    EXPECT_TRUE(std::isnan(pairing->p_holm));  // two discordant pairs: it could not be significant
    EXPECT_NEAR(pairing->least_p, 0.5, 1e-12);
    EXPECT_EQ(pairing->verdict, reports::Verdict::Open);
}

TEST(Summary, JudgesByTheMargin) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        runs.push_back(test::runOf("gap", seed, "W-RoI", "astar", seed < 2 ? kHit : kWon));
        runs.push_back(test::runOf("gap", seed, "W-Full", "astar", seed == 2 ? kHit : kWon));
        runs.push_back(test::runOf("gap", seed, "G-Full", "astar", kWon));
        runs.push_back(test::runOf("gap", seed, "W-RoI", "straight", seed < 100 ? kLate : kWon));
    }
    const reports::Summary summary = reports::summarize(runs);
    ASSERT_EQ(summary.overall.size(), 4u);
    for (const reports::Pairing& pairing : summary.overall) {
        const bool is_worse = pairing.first.guidance == "straight";
        EXPECT_EQ(pairing.verdict,
                  is_worse ? reports::Verdict::Inferior : reports::Verdict::NotInferior)
            << nameOf(pairing.first) << " " << nameOf(pairing.second);
    }
}

TEST(Summary, ATotalCountsACourseOnceAndTellsTheLargestScenario) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        for (const char* model : {"W-RoI", "D-Full"}) {
            const auto outcome = model[0] == 'W' && seed < 4 ? kHit : kWon;
            if (seed < 10) runs.push_back(test::runOf("wires", seed, model, "astar", outcome));
            if (seed < 10) runs.push_back(test::runOf("wires-thin", seed, model, "astar", outcome));
            runs.push_back(test::runOf("movers", seed, model, "astar", kWon));
        }
    }
    const reports::Summary summary = reports::summarize(runs);
    ASSERT_EQ(summary.overall.size(), 1u);
    const reports::Pairing& total = summary.overall.front();
    EXPECT_EQ(total.pairs(), 40);  // of wires and movers
    EXPECT_EQ(total.only_second, 4);
    EXPECT_EQ(total.scenarios, 2);
    EXPECT_EQ(total.largest_scenario, "movers");
    EXPECT_THAT(reports::differenceText(total),
                HasSubstr("30 of the 40 courses are of movers. 1 of 2 scenarios"));
    EXPECT_THAT(reports::differenceText(total),
                StartsWith("Undecided: Over all scenarios but thin wires at"));
    EXPECT_EQ(reports::summaryCsv(summary).find("\nall,"), std::string::npos);
    const auto shared = reports::sharedCourses(runs, summary, summary.conditions.front());
    ASSERT_EQ(shared.size(), 1u);
    EXPECT_EQ(shared[0].flown, 40);
    EXPECT_EQ(shared[0].min_clearances_m[0].size(), 40u);

    // Where another scenario was flown by one of them alone, the verdict names those of the total.
    auto with_gap = runs;
    with_gap.push_back(test::runOf("gap", 1, "W-RoI", "astar", kWon));
    EXPECT_THAT(reports::verdictOf(reports::summarize(with_gap)),
                Contains(StartsWith("Undecided: In movers and wires at 4 m/s")));

    // Thin wires of other layouts count.
    for (std::uint64_t seed = 100; seed < 103; ++seed) {
        for (const char* model : {"W-RoI", "D-Full"}) {
            with_gap.push_back(test::runOf("wires-thin", seed, model, "astar", kWon));
        }
    }
    const reports::Pairing more = reports::summarize(with_gap).overall.front();
    EXPECT_EQ(more.pairs(), 43);
    EXPECT_EQ(more.scenarios, 3);
    EXPECT_EQ(more.repeated, 10);
    EXPECT_THAT(reports::differenceText(more),
                HasSubstr(" 10 courses of thin wires with the layout of counted wires are left "));
    EXPECT_THAT(reports::differenceText(more), StartsWith("Undecided: Over all scenarios at"));

    // Without wires, thin wires count.
    runs.erase(std::remove_if(runs.begin(), runs.end(),
                              [](const Row& run) { return run.scenario == "wires"; }),
               runs.end());
    EXPECT_EQ(reports::summarize(runs).overall.front().pairs(), 40);
}

TEST(Summary, TheHighestSpeedIsTheLastBeforeTheFirstFailure) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        for (const double speed_m_s : {4.0, 6.0, 8.0, 10.0}) {
            const bool fails = speed_m_s == 8 && seed < 6;  // 94 %
            runs.push_back(
                test::runOf("forest-0.10", seed, "W-RoI", "astar", fails ? kHit : kWon, speed_m_s));
        }
    }
    const reports::Summary summary = reports::summarize(runs);
    ASSERT_EQ(summary.speed_limits.size(), 1u);
    EXPECT_EQ(summary.speed_limits[0].highest_m_s, 6);
    EXPECT_EQ(summary.speed_limits[0].sure_m_s, 6);  // 100 of 100: 96.3 % and more
    EXPECT_EQ(summary.speed_limits[0].flown_m_s, 10);
    EXPECT_EQ(trials::deviationOf(summary.speed_limits[0].lowest), "");
}

TEST(SharedCourses, AreThoseOnWhichAllArrived) {
    std::vector<Row> runs = threeContenders();
    runs.push_back(test::runOf("gap", 99, "W-RoI", "astar", kWon));  // nobody else flew it
    for (Row& run : runs) {
        if (run.setup.model == "W-RoI" && run.seed < 5) run.result.time_s = 100;
        if (run.seed != 7) run.result.first_reaction_m = static_cast<double>(run.seed);
    }
    const reports::Summary summary = reports::summarize(runs);
    const std::vector<reports::SharedCourses> shared =
        reports::sharedCourses(runs, summary, kReference);
    ASSERT_EQ(shared.size(), 2u);
    EXPECT_EQ(shared[0].guidance, "astar");
    EXPECT_EQ(shared[0].flown, 10);
    EXPECT_EQ(shared[0].arrived, 7);  // 3 to 9: the map was late on 0, 1 and 2
    EXPECT_EQ(shared[0].reacted, 6);
    ASSERT_EQ(shared[0].cells.size(), 2u);
    EXPECT_EQ(shared[0].cells[0].contender.model, "W-RoI");
    for (const reports::Cell& cell : shared[0].cells) {
        EXPECT_EQ(cell.time_s.count, 7);
        EXPECT_NEAR(cell.time_s.median, 12, 1e-12);  // of all its own it would be 56
        EXPECT_EQ(cell.first_reaction_m.count, 6);
    }
    EXPECT_EQ(shared[0].min_clearances_m[1].size(), 10u);
    ASSERT_EQ(shared[0].flown_cells.size(), 2u);
    for (const reports::Cell& cell : shared[0].flown_cells) {
        EXPECT_EQ(cell.runs, 10);  // W-RoI flew 11
        EXPECT_NEAR(cell.stops_per_km, 2 / 0.044, 1e-9);
    }
    EXPECT_EQ(reports::flownTogetherSentence(shared[0]),
              "With A*: both contenders flew the same 10 courses.");
    EXPECT_EQ(
        reports::sharedCoursesSentence(shared[0]),
        "With A*: both contenders flew the same 10 courses; both reached the goal on 7 of them "
        "and reacted to an obstacle on 6.");
    EXPECT_EQ(shared[1].arrived, 0);
    EXPECT_TRUE(shared[1].cells.empty());
    EXPECT_EQ(reports::sharedCoursesSentence(shared[1]),
              "With straight guidance: RoI window flew 10 courses; it never reached the goal.");
}

/// Maps are slow to fly: their few courses must not limit the table of the others.
TEST(SharedCourses, WhoFlewFewerComesInWithATableOfItsOwn) {
    std::vector<Row> runs;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        runs.push_back(test::runOf("gap", seed, "W-RoI", "astar", kWon));
        if (seed < 19) runs.push_back(test::runOf("gap", seed, "G-Full", "astar", kWon));
        if (seed < 4) runs.push_back(test::runOf("gap", seed, "O-Full-0.4", "astar", kWon));
    }
    const std::vector<reports::SharedCourses> shared =
        reports::sharedCourses(runs, reports::summarize(runs), kReference);
    ASSERT_EQ(shared.size(), 2u);
    EXPECT_EQ(shared[0].contenders.size(), 2u);
    EXPECT_EQ(shared[0].arrived, 19);
    EXPECT_EQ(shared[1].contenders.size(), 3u);
    EXPECT_EQ(shared[1].arrived, 4);
}

TEST(Summary, SectorsAreAConditionOfTheirOwnAndNamedWhereTheyWereFlown) {
    std::vector<Row> runs{runOf("gap", 1, "W-RoI", "astar", kWon)};
    const reports::Summary scans = reports::summarize(runs);
    EXPECT_EQ(reports::summaryCsv(scans).find("updates"), std::string::npos);
    EXPECT_EQ(reports::summaryJson(scans, {}).find("updates"), std::string::npos);
    runs.push_back(runOf("gap", 1, "W-RoI", "astar", kHit));
    runs[1].setup.updates = trials::Updates::Sectors;
    const reports::Summary both = reports::summarize(runs);
    ASSERT_EQ(both.conditions.size(), 2u);
    EXPECT_EQ(nameOf(both.conditions[1]), "4 m/s, sectors");
    const std::string table = reports::summaryCsv(both);
    EXPECT_THAT(table, HasSubstr(",air,distance,updates\n"));
    EXPECT_THAT(table, HasSubstr(",dusty,unbiased,scans\n"));
    EXPECT_THAT(table, HasSubstr(",dusty,unbiased,sectors\n"));
    EXPECT_THAT(reports::summaryJson(both, {}), HasSubstr("\"updates\": \"sectors\""));
}

TEST(Summary, OfNothingIsEmpty) {
    EXPECT_TRUE(reports::summarize({}).cells.empty());
    EXPECT_THAT(reports::reportPage(reports::Report{}), HasSubstr("There are no runs."));
}

}  // namespace
}  // namespace hagen
