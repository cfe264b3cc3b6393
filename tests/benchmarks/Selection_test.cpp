// The logic behind scripts/select-settings.
#include <gmock/gmock.h>

#include <cmath>

#include "selection/Descent.h"
#include "selection/Plan.h"
#include "selection/Record.h"
#include "selection/SelectionTables.h"
#include "support/Program.h"

namespace hagen::selection {
namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;

namespace fs = std::filesystem;
const fs::path kConfig = HAGEN_SOURCE_DIR "/config";

constexpr std::int64_t kReturns = 100000;

/// Counts with this F1 in both classes; misses equal false alarms.
Counts countsOf(double f1, std::int64_t missed = 0) {
    const auto wrong = std::llround((1 - f1) * kReturns);
    const evaluation::ClassScore score{kReturns - wrong, wrong, wrong};
    return {{score, score}, {missed, kReturns}};
}

/// Two settings with five values each, and three drives. The F1 of a drive falls with the squared
/// distance from its own optimum.
const std::vector<Setting> kSettings{{"a", {"0", "1", "2", "3", "4"}},
                                     {"b", {"0", "1", "2", "3", "4"}}};
const std::vector<ScanSet> kDrives{
    {"x", "x", Group::Real, true}, {"y", "y", Group::Real, true}, {"z", "z", Group::Real, true}};
const std::vector<Choice> kBest{{0, 3}, {0, 3}, {4, 1}};

double bowl(const Choice& choice, const Choice& best) {
    double sum = 0;
    for (std::size_t s = 0; s < choice.size(); ++s) {
        const double off = static_cast<double>(choice[s]) - static_cast<double>(best[s]);
        sum += off * off;
    }
    return 0.9 - 0.02 * sum;
}

std::vector<Counts> bowls(const Choice& choice) {
    std::vector<Counts> counts;
    for (const Choice& best : kBest) counts.push_back(countsOf(bowl(choice, best)));
    return counts;
}

/// No limit on missed returns.
const MissedByGroup kAny{kReturns, kReturns, kReturns};

/// The best choice, by exhaustive search.
Choice bruteForce(const std::string& left_out) {
    Choice best;
    double max = -INFINITY;
    for (std::size_t a = 0; a < 5; ++a) {
        for (std::size_t b = 0; b < 5; ++b) {
            const double objective = objectiveOf(kDrives, bowls({a, b}), left_out);
            if (objective <= max) continue;
            max = objective;
            best = {a, b};
        }
    }
    return best;
}

TEST(Objective, AveragesBothClasses) {
    // Sets with the same vote are summed first: each vote has the same weight, whatever its size.
    const std::vector<ScanSet> sets{{"rain", "x", Group::Hard, true},
                                    {"rain", "y", Group::Hard, true},
                                    {"flights", "", Group::Simulated, true}};
    Counts rain_x, rain_y, flights;
    rain_x.scores.roi = {10, 0, 0};
    rain_x.scores.rou = {10, 0, 0};
    rain_y.scores.roi = {0, 20, 0};   // with rain_x: 2 * 10 / (20 + 20)
    rain_y.scores.rou = {10, 0, 20};  // with rain_x: 2 * 20 / (40 + 20)
    flights.scores.roi = {9, 1, 1};
    flights.scores.rou = {9, 1, 1};
    const double rain = (0.5 + 2.0 / 3) / 2;
    EXPECT_DOUBLE_EQ(objectiveOf(sets, {rain_x, rain_y, flights}, ""), (rain + 0.9) / 2);
    EXPECT_DOUBLE_EQ(objectiveOf(sets, {rain_x, rain_y, flights}, "y"), (1 + 0.9) / 2);
    // A vote without scored returns is ignored.
    EXPECT_DOUBLE_EQ(objectiveOf(sets, {{}, {}, flights}, ""), 0.9);
}

TEST(MissedOf, CountsUsedScansOnce) {
    const std::vector<ScanSet> sets{{"a", "x", Group::Real, true},
                                    {"a, no vegetation", "x", Group::Real, false},
                                    {"b", "y", Group::Real, true},
                                    {"c", "", Group::Simulated, true},
                                    {"d", "x", Group::Hard, true}};
    std::vector<Counts> counts;
    for (const std::int64_t missed : {1, 10, 100, 1000, 10000})
        counts.push_back(countsOf(0.9, missed));
    EXPECT_THAT(missedOf(sets, counts, ""), ElementsAre(101, 1000, 10000));
    EXPECT_THAT(missedOf(sets, counts, "x"), ElementsAre(100, 1000, 0));
}

TEST(Folds, LeaveOutEachDriveOnce) {
    EXPECT_THAT(drivesOf({{"16", "07", Group::Real, true},
                          {"64", "07", Group::Real, true},
                          {"flights", "", Group::Simulated, true},
                          {"16", "00", Group::Real, true}}),
                ElementsAre("00", "07"));
}

TEST(Descend, FindsTrainingOptimum) {
    CachedMeasure measure(bowls);
    for (const std::string left_out : {"", "x", "y", "z"}) {
        const Descended d = descend(kSettings, {2, 2}, kAny, kDrives, measure, left_out, 10);
        EXPECT_EQ(d.choice, bruteForce(left_out)) << left_out;
        EXPECT_DOUBLE_EQ(d.start, objectiveOf(kDrives, bowls({2, 2}), left_out));
        EXPECT_DOUBLE_EQ(d.objective, objectiveOf(kDrives, bowls(d.choice), left_out));
        EXPECT_LE(d.rounds, 2);  // the settings do not depend on each other
    }
    // Leaving out a drive matters: the optimum of z is far from the others.
    EXPECT_EQ(descend(kSettings, {2, 2}, kAny, kDrives, measure, "z", 10).choice, (Choice{0, 3}));
    EXPECT_NE(descend(kSettings, {2, 2}, kAny, kDrives, measure, "x", 10).choice, (Choice{0, 3}));
}

TEST(Descend, RepeatsForDependentSettings) {
    // A diagonal valley; the descent visits (0, 0), (1, 2), (3, 4), (4, 4).
    const auto valley = [](const Choice& c) {
        const double a = static_cast<double>(c[0]), b = static_cast<double>(c[1]);
        return std::vector<Counts>{
            countsOf(0.9 - 0.01 * (a - b) * (a - b) - 0.02 * std::abs(a + b - 8))};
    };
    const std::vector<ScanSet> one{{"x", "x", Group::Real, true}};
    CachedMeasure measure(valley);
    const auto within = [&](int rounds) {
        return descend(kSettings, {0, 0}, kAny, one, measure, "", rounds);
    };
    EXPECT_EQ(within(1).choice, (Choice{1, 2}));
    EXPECT_EQ(within(2).choice, (Choice{3, 4}));
    EXPECT_EQ(within(20).choice, (Choice{4, 4}));
    EXPECT_EQ(within(20).rounds, 4);  // the last round changes nothing
}

TEST(Descend, KeepsValuesWithoutGain) {
    const auto flat = [](const Choice& choice) {
        return std::vector<Counts>{
            countsOf(0.9 + 0.4 * kMinGain * static_cast<double>(choice[0]) / 4)};
    };
    const std::vector<ScanSet> one{{"x", "x", Group::Real, true}};
    CachedMeasure measure(flat);
    EXPECT_EQ(descend(kSettings, {2, 2}, kAny, one, measure, "", 5).choice, (Choice{2, 2}));
}

const std::vector<ScanSet> kGroupsOfSets{{"real", "x", Group::Real, true},
                                         {"other", "y", Group::Real, true},
                                         {"flights", "", Group::Simulated, true}};

/// Compared with (0, 0), the optimum (4, 4) misses more in the flights and less in x.
std::vector<Counts> trade(const Choice& choice) {
    const double f1 = bowl(choice, {4, 4});
    const std::int64_t more = choice[0] > 2 ? 5 : 0;
    return {countsOf(f1, 100 - 2 * more), countsOf(f1, 10), countsOf(f1, 50 + more)};
}

TEST(Descend, RespectsLimitInEachGroup) {
    CachedMeasure measure(trade);
    const MissedByGroup limit = missedOf(kGroupsOfSets, trade({0, 0}), "");
    const Descended d = descend(kSettings, {0, 0}, limit, kGroupsOfSets, measure, "", 5);
    EXPECT_EQ(d.choice, (Choice{2, 4}));
    EXPECT_THAT(d.missed_start, ElementsAre(110, 50, 0));
    EXPECT_THAT(d.missed, ElementsAre(110, 50, 0));
    EXPECT_EQ(descend(kSettings, {0, 0}, kAny, kGroupsOfSets, measure, "", 5).choice,
              (Choice{4, 4}));
}

TEST(Descend, ReducesMissesBelowLimitFirst) {
    CachedMeasure measure(trade);
    const MissedByGroup limit = missedOf(kGroupsOfSets, trade({0, 0}), "");
    const Descended d = descend(kSettings, {4, 0}, limit, kGroupsOfSets, measure, "", 5);
    EXPECT_EQ(d.choice, (Choice{2, 4}));
    EXPECT_EQ(d.missed_start[1], 55);
    EXPECT_EQ(d.missed[1], 50);
}

TEST(CachedMeasure, MeasuresChoicesOnce) {
    int calls = 0;
    CachedMeasure measure([&](const Choice& choice) {
        ++calls;
        return bowls(choice);
    });
    for (const std::string left_out : {"", "x", "y", "z", ""})
        descend(kSettings, {2, 2}, kAny, kDrives, measure, left_out, 10);
    EXPECT_EQ(static_cast<std::size_t>(calls), measure.measured());
    EXPECT_LE(calls, 25);
}

// Student's t for four values: mean +- 3.182 standard errors.
TEST(MeanOverDrives, HasStudentInterval) {
    const MeanInterval interval = meanOverDrives({0.9, 0.92, 0.94, 0.96});
    EXPECT_DOUBLE_EQ(interval.mean, 0.93);
    const double error = std::sqrt((0.0009 + 0.0001 + 0.0001 + 0.0009) / 3 / 4);
    EXPECT_NEAR(interval.low, 0.93 - 3.182 * error, 1e-12);
    EXPECT_NEAR(interval.high, 0.93 + 3.182 * error, 1e-12);
    EXPECT_TRUE(std::isnan(meanOverDrives({0.9}).low));
    EXPECT_TRUE(std::isnan(meanOverDrives(std::vector<double>(32, 0.9)).low));
}

// ---- the plan

TEST(Plan, ProjectPlanHasValidValues) {
    Plan plan = readPlan(kConfig / "selection.yaml");
    EXPECT_GE(plan.settings.size(), 10u);
    const std::size_t tolerances = plan.settings.front().values.size();
    EXPECT_EQ(plan.settings.front().key, "ground_tolerance_m");
    const Choice present = presentChoice({kConfig / "vlp16.yaml", kConfig / "hdl64e.yaml"}, plan);
    ASSERT_EQ(present.size(), plan.settings.size());
    EXPECT_LE(plan.settings.front().values.size(), tolerances + 1);
    Settings chosen, preset;
    apply(plan.settings, present, chosen);
    mergeSettings(kConfig / "vlp16.yaml", preset);
    EXPECT_EQ(chosen.options.ground_tolerance_m, preset.options.ground_tolerance_m);
}

TEST(Plan, PlainStartUsesOwnValues) {
    test::TemporaryFolder folder;
    Plan plan = readPlan(folder.write(
        "plan.yaml",
        "settings: {beta_deg: [5, 7.5], grow_feet: [true, false]}\nplain: {beta_deg: 7.50}\n"));
    const fs::path preset = folder.write("preset.yaml", "beta_deg: 11\n");
    const Choice present = presentChoice({preset}, plan);
    EXPECT_THAT(present, ElementsAre(0, 0));
    EXPECT_THAT(plainChoice(plan, present), ElementsAre(2, 0));
}

// ---- the record

Record twoDrives() {
    Record record;
    record.revision = "v1";
    record.seeds = {1, 2};
    record.hard_sets = {"rain=1"};
    record.scans = 12;
    record.measured = 34;
    record.settings = {{"beta_deg", "10", {"5", "10"}}};
    record.searches = {{"the presets",
                        {{"", {"10"}, 0.9, 0.91, {3, 2, 1}, {2, 2, 1}, {3, 2, 1}, 2},
                         {"02", {"5"}, 0.9, 0.92, {3, 2, 1}, {2, 2, 1}, {3, 2, 1}, 2}}},
                       {"a plain start", {}}};
    // Scores of each search: from the presets, and from a plain start.
    record.scores = {{"real",
                      "00",
                      countsOf(0.95, 3),
                      {countsOf(0.94, 5), countsOf(0.93, 5)},
                      {countsOf(0.90, 7), countsOf(0.80, 7)}},
                     {"real",
                      "02",
                      countsOf(0.96, 3),
                      {countsOf(0.94, 5), countsOf(0.93, 5)},
                      {countsOf(0.92, 7), countsOf(0.84, 7)}}};
    return record;
}

TEST(Record, RoundTripsThroughJson) {
    test::TemporaryFolder folder;
    const std::string text = jsonOf(twoDrives());
    const Record record = readRecord(folder.write("selection.json", text));
    EXPECT_EQ(jsonOf(record), text);
    EXPECT_EQ(record.searches[0].folds[1].chosen[0], "5");
    EXPECT_EQ(record.find("real", "02")->with_all[0].missed.missed, 5);
    EXPECT_EQ(record.find("real", "04"), nullptr);
}

TEST(SelectionTables, ListHeldOutScoresFirst) {
    const std::string text = scoreTable(twoDrives());
    EXPECT_THAT(text, HasSubstr("0.900 / 0.900"));
    EXPECT_THAT(text, HasSubstr("**0.910 / 0.910**"));  // held-out mean
    EXPECT_THAT(text, HasSubstr("0.783 to 1.000"));     // 0.91 +- 12.706 * 0.01, clipped at 1
    EXPECT_THAT(text, HasSubstr("0.955 / 0.955"));      // mean of the current settings
    EXPECT_THAT(text, HasSubstr("14 of 200000 (0.01 %)"));
    EXPECT_THAT(text, ContainsRegex("from a plain start.. +\\| ..0.820 / 0.820"));
    EXPECT_LT(text.find("held out"), text.find("in-sample"));
    const Search search = twoDrives().searches[0];
    EXPECT_THAT(choiceTable(twoDrives(), search).text(),
                ContainsRegex("beta_deg` \\| 10 +\\| 10 +\\| \\*\\*5\\*\\*"));
    EXPECT_THAT(foldTable(search).text(), HasSubstr("0.9000 to 0.9100"));
    EXPECT_THAT(foldTable(search).text(), HasSubstr("3 to 2, limit 3"));
}

}  // namespace
}  // namespace hagen::selection
