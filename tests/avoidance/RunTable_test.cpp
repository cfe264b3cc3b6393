#include "avoidance/flights/RunTable.h"
#include <gmock/gmock.h>
#include <hagen/simulation/Random.h>
#include "base/NumberText.h"

#include <algorithm>
#include <clocale>
#include <cmath>

#include "support/Program.h"

namespace hagen::avoidance {
namespace {

using testing::HasSubstr;

using Row = hagen::avoidance::Run;  // testing::Test has a member Run()

Row someRun() {
    Row run{};
    run.scenario = "forest-0.05";
    run.seed = 1007;
    run.setup.speed_m_s = 4;
    run.result = {Outcome::Success, 0.7312, 43.25, 12.34, NAN, 21.5, 123, 4, 1, 3.5, 7.25, 9};
    run.oracle_path_m = 41.5;
    run.settings_hash = "1234abcd";
    run.version = "0.1.0";
    return run;
}

TEST(RunTable, RowMatchesHeader) {
    EXPECT_EQ(runHeader(),
              "scenario,seed,model,guidance,speed,outcome,min_clearance_m,path_m,time_s,planner,"
              "pose_error,latency_scale,unknown,oracle_path_m,first_reaction_m,rms_jerk_m_s3,scans,"
              "dropped_scans,emergency_stops,latency_p50_ms,latency_p95_ms,latency_max_ms,settings,"
              "version,air,distance,updates");
    EXPECT_EQ(rowOf(someRun()),
              "forest-0.05,1007,W-RoI,astar,4,success,0.7312,43.250,12.340,primitives,none,1,"
              "optimistic,41.500,,21.500,123,4,1,3.500,7.250,9.000,1234abcd,0.1.0,dusty,unbiased,"
              "scans");
}

TEST(RunTable, IgnoresLocaleAndNegativeZero) {
    Row run = someRun();
    run.result.min_clearance_m = -1e-9;
    std::setlocale(LC_ALL, "de_DE.UTF-8");  // decimal commas, if installed
    const std::string row = rowOf(run);
    std::setlocale(LC_ALL, "C");
    EXPECT_THAT(row, HasSubstr(",success,0.0000,43.250,"));
}

/// A random run with few distinct values, so that sorting meets ties.
Row anyRun(simulation::Random& random) {
    Row run = someRun();
    run.scenario = random.chance(0.5) ? "gap" : "u-trap";
    run.seed = random.uniformInt(1000000);
    run.setup.model = random.chance(0.5) ? "W-Full" : "O-RoI+rays-0.2";
    run.setup.guidance = random.chance(0.5) ? "straight" : "astar";
    run.setup.planner = random.chance(0.5) ? "3dvfh" : "primitives";
    run.setup.speed_m_s = random.chance(0.5) ? 10 : 2.5;
    run.setup.pose_error = static_cast<PoseError>(random.uniformInt(3));
    run.setup.latency_scale = random.chance(0.5) ? 4 : 1;
    run.setup.brakes_in_known_space = random.chance(0.5);
    run.setup.air = random.chance(0.5) ? Air::Clear : Air::Dusty;
    run.setup.distance = random.chance(0.5) ? ModelDistance::AsStored : ModelDistance::Unbiased;
    run.setup.updates = random.chance(0.5) ? Updates::Sectors : Updates::Scans;
    run.result.outcome = static_cast<Outcome>(random.uniformInt(3));
    for (double TrialResult::*field :
         {&TrialResult::min_clearance_m, &TrialResult::path_m, &TrialResult::time_s,
          &TrialResult::rms_jerk_m_s3, &TrialResult::latency_max_ms}) {
        run.result.*field = random.chance(0.1) ? NAN : random.uniform(-1, 100);
    }
    run.result.scans = random.uniformInt(300);
    return run;
}

TEST(RunTable, RoundTrips) {
    const test::TemporaryFolder folder;
    simulation::Random random(1);
    std::string text = runHeader() + "\n";
    for (int r = 0; r < 300; ++r) text += rowOf(anyRun(random)) + "\n";
    const std::vector<Row> runs = readRuns(folder.write("runs.csv", text));
    ASSERT_EQ(runs.size(), 300u);
    std::string again = runHeader() + "\n";
    for (const Row& run : runs) again += rowOf(run) + "\n";
    EXPECT_EQ(again, text);
    EXPECT_TRUE(std::isnan(runs[0].result.first_reaction_m));
}

TEST(RunTable, KeyRoundTrips) {
    EXPECT_EQ(keyOf(someRun()),
              "forest-0.05,1007,W-RoI,astar,4,primitives,none,1,optimistic,dusty,unbiased,scans");
    simulation::Random random(3);
    for (int r = 0; r < 300; ++r) {
        const Row run = anyRun(random);
        Row unflown = runOfKey(keyOf(run));
        EXPECT_EQ(keyOf(unflown), keyOf(run));
        unflown.result = run.result;
        unflown.oracle_path_m = run.oracle_path_m;
        unflown.settings_hash = run.settings_hash;
        unflown.version = run.version;
        EXPECT_EQ(rowOf(unflown), rowOf(run));
    }
    EXPECT_EQ(test::messageOf([] { runOfKey("gap,1"); }), "2 fields, not 12");
    EXPECT_EQ(test::messageOf([] {
                  runOfKey("gap,x,W-RoI,astar,4,primitives,none,1,optimistic,clear,unbiased,scans");
              }),
              "column seed: \"x\" is not a number");
}

TEST(RunTable, SortingIsDeterministic) {
    simulation::Random random(2);
    std::vector<Row> runs;
    for (int r = 0; r < 200; ++r) runs.push_back(anyRun(random));
    std::vector<Row> reversed(runs.rbegin(), runs.rend());
    sortRuns(runs);
    sortRuns(reversed);
    ASSERT_EQ(runs.size(), reversed.size());
    for (std::size_t r = 0; r < runs.size(); ++r) EXPECT_EQ(rowOf(runs[r]), rowOf(reversed[r]));
    EXPECT_TRUE(std::is_sorted(runs.begin(), runs.end(), [](const Row& a, const Row& b) {
        return a.scenario < b.scenario ||
               (a.scenario == b.scenario && a.setup.speed_m_s < b.setup.speed_m_s);
    }));
}

TEST(RunTable, ReportsBrokenLineAndColumn) {
    const test::TemporaryFolder folder;
    const std::string good = rowOf(someRun());
    const auto broken = [&](const std::string& row) {
        return test::messageOf([&] {
            readRuns(folder.write("runs.csv", runHeader() + "\n" + good + "\n" + row + "\n"));
        });
    };
    const std::string at = (folder / "runs.csv").string() + ":3: ";
    EXPECT_EQ(broken("gap,1"), at + "2 fields, not 27");
    EXPECT_EQ(broken(good + ",1"), at + "28 fields, not 27");
    EXPECT_EQ(broken(""), at + "1 fields, not 27");
    const auto with = [&](const std::string& from, const std::string& to) {
        return std::string(good).replace(good.find(from), from.size(), to);
    };
    EXPECT_EQ(broken(with("1007", "-1")), at + "column seed: \"-1\" is not a number");
    EXPECT_EQ(broken(with("43.250", "43.25m")), at + "column path_m: \"43.25m\" is not a number");
    EXPECT_EQ(broken(with(",123,", ",,")), at + "column scans: \"\" is not a number");
    for (const char* speed : {"0", "-1", "nan", "inf", "1e300"}) {
        auto run = someRun();
        const std::string text = "," + base::shortestText(run.setup.speed_m_s) + ",success";
        EXPECT_THAT(broken(with(text, std::string(",") + speed + ",success")),
                    testing::StartsWith(at + "column speed: "));
    }
    EXPECT_EQ(broken(with("success", "won")),
              at + "column outcome: \"won\" is not one of success, collision, timeout");
    EXPECT_EQ(broken(with("scans", "turns")),
              at + "column updates: \"turns\" is not one of scans, sectors");
    EXPECT_EQ(broken(with("optimistic", "")),
              at + "column unknown: \"\" is not one of optimistic, brake_known");
}

TEST(RunTable, ReportsInvalidFile) {
    const test::TemporaryFolder folder;
    const auto said = [](const std::filesystem::path& file) {
        return test::messageOf([&] { readRuns(file); });
    };
    EXPECT_EQ(said(folder / "no.csv"),
              (folder / "no.csv").string() + ": cannot be read: No such file or directory");
    EXPECT_THAT(said(folder.write("a.csv", "")), HasSubstr("a.csv:1: is empty"));
    EXPECT_THAT(said(folder.write("b.csv", "a,b\n1,2\n")), HasSubstr("b.csv:1: wrong header"));
}

}  // namespace
}  // namespace hagen::avoidance
