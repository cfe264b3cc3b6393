// The tools behind scripts/benchmark and scripts/measure-performance.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <set>

#include "performance/Document.h"
#include "performance/StageRows.h"
#include "performance/TimedRows.h"
#include "support/Program.h"

namespace hagen {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

TimedRow rowOf(const std::string& sensor, const std::string& what, double median_ms) {
    TimedRow row{sensor, what, evaluation::latencyOf(std::vector<double>(10, median_ms)), 0.5};
    return row;
}

TEST(TimedRows, ExponentIsLogLogSlope) {
    const std::vector<double> x{16, 32, 64, 128};
    for (const double exponent : {0.0, 1.0, 1.5}) {
        std::vector<double> y;
        for (const double value : x) y.push_back(7 * std::pow(value, exponent));
        EXPECT_NEAR(exponentOf(x, y), exponent, 1e-12);
    }
}

TEST(StageRows, HaveExpectedNames) {
    std::set<std::string> names;
    for (const StageRow& row : stageRows()) EXPECT_TRUE(names.insert(row.what).second) << row.what;
    for (const char* name :
         {"floor", "mrpt decode", "paper pipeline", "default pipeline", "zermas ground fit"}) {
        EXPECT_EQ(names.count(name), 1u) << name;
    }
    const Input input = gridScan(16, 435);
    EXPECT_EQ(input.sensor, "16 x 435");
    EXPECT_GT(input.points.front().size(), 3000u);
    Options options;
    options.columns = 435;
    Case one(input, 0, options);
    EXPECT_GT(one.result.returns.roi.size(), 100u);
    for (const StageRow& row : stageRows()) {
        if (row.needs_packets) continue;
        EXPECT_NO_THROW(row.run(one)) << row.what;
    }
}

/// A document with a few rows.
Performance small() {
    Performance p;
    for (const char* sensor : {"VLP-16", "16 x 435", "16 x 870", "16 x 1740", "16 x 3480",
                               "32 x 870", "64 x 870", "128 x 870"}) {
        p.rows.push_back(rowOf(sensor, "mrpt decode", 0.5));
        p.rows.push_back(rowOf(sensor, "paper pipeline", 0.25));
        p.rows.push_back(rowOf(sensor, "default pipeline", 0.375));
        p.rows.push_back(rowOf(sensor, "1 depth image", 0.0042));
    }
    p.packets_to_labels = {{"paper", evaluation::latencyOf({1, 2, 3})}};
    p.table = {"orchard", {100, 300}, {{"a method", {1, 3}}}};
    p.chart = {p.table};
    return p;
}

TEST(PerformanceDocument, ListsMeasurements) {
    const std::string text = documentOf(small());
    EXPECT_THAT(text, HasSubstr("| VLP-16 | `paper pipeline`   | 250    | 250 | 0.50          | "
                                "0.5         |"));
    EXPECT_THAT(text,
                HasSubstr("takes 1.50 to 1.50 times as long as the paper's and 0.75 to 0.75"));
    EXPECT_THAT(text, HasSubstr("| 1 depth image        | 4.2    |"));
    EXPECT_THAT(text, HasSubstr("| fitted exponent | 0.00 "));
    EXPECT_THAT(text, HasSubstr("2 VLP-16 scans of 200 returns on average"));
    EXPECT_THAT(text, HasSubstr("| 2.000 +- 1.414 "));
    EXPECT_THAT(text, Not(ContainsRegex("[^a-z]nan[^a-z]")));
}

TEST(StageBenchmarksRun, WritesTableAndJson) {
    test::TemporaryFolder folder;
    const fs::path json = folder / "stages.json";
    const test::Outcome outcome = test::run(
        HAGEN_STAGE_BENCHMARKS,
        {"--json", json.string(), "--benchmark_filter=VLP-16/(floor|mrpt decode|2 gap repair)",
         "--benchmark_min_time=0.001"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("VLP-16, microseconds"));
    const std::vector<TimedRow> rows = readTimedRows(json);
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_NE(find(rows, "VLP-16", "mrpt decode"), nullptr);
    EXPECT_EQ(test::run(HAGEN_STAGE_BENCHMARKS, {"--jason", json.string()}).exit_code, 2);
}

}  // namespace
}  // namespace hagen
