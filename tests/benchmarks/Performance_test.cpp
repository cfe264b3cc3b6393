// The tools behind scripts/benchmark and scripts/measure-performance.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <set>

#include "performance/Document.h"
#include "performance/StageRows.h"
#include "performance/TimedRows.h"
#include "support/Program.h"
#include "support/Random.h"

namespace hagen {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

evaluation::Latency always(double ms) { return evaluation::latencyOf(std::vector<double>(10, ms)); }

TEST(TimedRows, ExponentIsLogLogSlope) {
    const std::vector<double> x{16, 32, 64, 128};
    for (const double exponent : {0.0, 1.0, 1.5}) {
        std::vector<double> y;
        for (const double value : x) y.push_back(7 * std::pow(value, exponent));
        EXPECT_NEAR(exponentOf(x, y), exponent, 1e-12);
    }
}

TEST(StageRows, AllRunOnEachSensor) {
    for (const Input& input : {simulatedOs1(64, 1), simulatedPackets("VLP-16", 1)}) {
        ASSERT_EQ(input.size(), 4u);
        std::set<std::string> names;
        for (const auto& groups : {pipelines(), stages()}) {
            for (const StageGroup& group : groups) {
                Case one(input, group.options);
                one.loadResults(1);
                EXPECT_GT(one.result.returns.roi.size(), 100u);
                for (const StageRow& row : group.rows) {
                    EXPECT_TRUE(names.insert(row.what).second) << row.what;
                    if (row.what == kMrptDecode && input.packets.empty()) continue;
                    EXPECT_NO_THROW(row.run(one)) << row.what;
                }
            }
        }
        for (const std::string& name :
             {kMrptDecode, kPaperPipeline, kDefaultPipeline, kFastPipeline}) {
            EXPECT_EQ(names.count(name), 1u) << name;
        }
    }
}

TEST(StageRows, StagesKeepLabels) {
    const Input input = simulatedPackets("VLP-16", 1);
    for (const StageGroup& group : stages()) {
        Case one(input, group.options);
        one.loadResults(1);
        const SegmentationResult before = one.result;
        for (const StageRow& row : group.rows) row.run(one);
        EXPECT_EQ(one.result.returns.label, before.returns.label);
        EXPECT_TRUE((one.result.labels == before.labels).all());
        if (before.ground.has_surface) {
            EXPECT_TRUE(test::same(one.result.ground.tolerance_m, before.ground.tolerance_m));
        }
    }
}

TEST(Inputs, ScansDiffer) {
    std::set<std::size_t> returns;
    for (const Scan& scan : simulatedOs1(64, 2).points) returns.insert(scan.size());
    EXPECT_EQ(returns.size(), 8u);
    EXPECT_GT(*returns.begin(), 2000u);
    EXPECT_LE(*returns.rbegin(), 128u * 64u);
}

/// A document with a few rows; time is proportional to pixels.
Performance small() {
    Performance p;
    for (const auto& [sensor, scale] :
         {std::pair<std::string, int>{"VLP-16", 1}, {"HDL-32E", 2}, {"OS1-128/2048", 8}}) {
        const int pixels = 10000 * scale;
        const auto add = [&](const std::string& what, double warm_ms, double cold_ms) {
            p.rows.push_back(
                {sensor, what, pixels, always(scale * warm_ms), always(scale * cold_ms), 0.5});
        };
        add(kMrptDecode, 0.5, 1);
        add(kPaperPipeline, 0.25, 0.75);
        add(kDefaultPipeline, 0.375, 1);
        add(kFastPipeline, 0.3, 1);
        for (const char* stage : {"decode", "1 depth image"}) {
            p.rows.push_back({sensor, stage, pixels, always(0.0042 * scale), {}, 0});
        }
    }
    p.table = {"orchard", {100, 300}, {{"a method", {1, 3}}}};
    p.chart = {p.table};
    return p;
}

TEST(TimedRows, JsonRestoresRows) {
    const std::vector<TimedRow> rows = small().rows;
    test::TemporaryFolder folder;
    const std::vector<TimedRow> read = readTimedRows(folder.write("rows.json", jsonOf(rows)));
    EXPECT_EQ(jsonOf(read), jsonOf(rows));
    EXPECT_EQ(tableOf(read), tableOf(rows));
}

TEST(PerformanceDocument, ListsMeasurements) {
    const std::string text = documentOf(small());
    EXPECT_THAT(text, HasSubstr("A scan (VLP-16, OS1-128/2048) takes 0.4, 3.0 ms with the default "
                                "settings, and 0.3, 2.4 ms"));
    EXPECT_THAT(text, HasSubstr("0, 3 % of one core at 10 Hz, and 1, 6 % at 20 Hz"));
    EXPECT_THAT(text, HasSubstr("to the power of 1.00."));
    EXPECT_THAT(text, ContainsRegex("\\| VLP-16 +\\| paper +\\| 250/250/250 +\\| 0.50 +\\| "
                                    "750/750/750 +\\| 0.75 "));
    EXPECT_THAT(text, ContainsRegex("\\| 1 depth image +\\| 4.2 +\\| 8.4 +\\| 34 "));
    EXPECT_THAT(text, ContainsRegex("\\| HDL-32E +\\| 20000 +\\| 25 +\\| 38 +\\| 30 "));
    EXPECT_THAT(text, HasSubstr("2 VLP-16 scans of 200 returns on average"));
    EXPECT_THAT(text, HasSubstr("| a method      | 1.000 | 3.000 "));
    EXPECT_THAT(text, Not(ContainsRegex("[^a-z]nan[^a-z]")));
}

TEST(StageBenchmarksRun, WritesTableAndJson) {
    test::TemporaryFolder folder;
    const fs::path json = folder / "stages.json";
    const test::Outcome outcome =
        test::run(HAGEN_STAGE_BENCHMARKS,
                  {"--json", json.string(), "--filter", "VLP-16/(mrpt decode|2 gap repair|8)",
                   "--scans", "1", "--runs", "5"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("VLP-16, microseconds"));
    const std::vector<TimedRow> rows = readTimedRows(json);
    ASSERT_EQ(rows.size(), 3u);
    const TimedRow* const mrpt = find(rows, "VLP-16", kMrptDecode);
    ASSERT_NE(mrpt, nullptr);
    EXPECT_EQ(mrpt->warm.runs, 5u);
    EXPECT_EQ(mrpt->cold.runs, 5u);
    EXPECT_EQ(mrpt->pixels, 16 * 870);
    EXPECT_EQ(test::run(HAGEN_STAGE_BENCHMARKS, {"--jason", json.string()}).exit_code, 2);
}

}  // namespace
}  // namespace hagen
