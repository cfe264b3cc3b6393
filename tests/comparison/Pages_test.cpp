// Pages: their places, and the runs from above.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include <hagen/avoidance/WorldModel.h>
#include <hagen/pages/Page.h>
#include <hagen/pages/Table.h>
#include <hagen/replays/Overhead.h>
#include <hagen/reports/Figures.h>
#include <hagen/reports/Report.h>
#include <hagen/trials/Calibration.h>
#include <nlohmann/json.hpp>
#include "SampleRuns.h"

namespace hagen {
namespace {

using testing::HasSubstr;
using testing::Not;

using namespace test;

TEST(Overhead, ShowsTheWholeFlightAndMarksItsEnds) {
    replays::OverheadView view{
        test::runOf("gap", 0, "W-RoI", "astar", kHit), true, {5, 0}, {45, 0}, {}, {}, {}};
    view.track_m = {{5, 0}, {20, 30}};
    const std::string hit = replays::svgOf(view);
    // 5 m around 5 to 45 and 0 to 30, and half as wide again as high: 60 x 40.
    EXPECT_THAT(hit, HasSubstr("viewBox=\"-5.0 -35.0 60.0 40.0\""));
    EXPECT_THAT(hit, HasSubstr("class=\"hit\""));
    EXPECT_THAT(hit, Not(HasSubstr("class=\"end\"")));
    view.run.result.outcome = kLate;
    EXPECT_THAT(replays::svgOf(view), HasSubstr("class=\"end\""));
    view.track_m.clear();  // a straight way is shown with what is beside it
    EXPECT_THAT(replays::svgOf(view), HasSubstr("viewBox=\"0.0 -16.7 50.0 33.3\""));
    for (const char* mark : {"start", "goal", "end", "hit", "stop", "track", "obstacles"}) {
        EXPECT_THAT(replays::overheadLegend(), HasSubstr("class=\"" + std::string(mark) + "\""))
            << mark;
    }
}

/// Cells of a row that touch are one rectangle. The y axis of SVG points down.
TEST(Overhead, ObstaclesAreRectanglesOfTheirRows) {
    constexpr double kCell_m = replays::OverheadView::kCell_m;
    replays::OverheadView view{
        test::runOf("gap", 0, "W-RoI", "astar", kWon), true, {5, 0}, {45, 0}, {}, {}, {}};
    view.obstacle_cells = {{20, 4}, {40, 5}, {41, 5}, {42, 5}, {44, 5}, {45, 6}};
    const auto rectangle = [&](int column, int row, int columns) {
        const std::string length = pages::figure(kCell_m * columns, 1);
        return "M" + pages::figure(kCell_m * column, 1) + " " +
               pages::figure(-kCell_m * (row + 1), 1) + "h" + length + "v" +
               pages::figure(kCell_m, 1) + "h" + pages::figure(-kCell_m * columns, 1) + "z";
    };
    EXPECT_THAT(replays::svgOf(view), HasSubstr("\"" + rectangle(20, 4, 1) + rectangle(40, 5, 3) +
                                                rectangle(44, 5, 1) + rectangle(45, 6, 1) + "\""));
}

TEST(Pages, ShowTheWorstRunsThatCanBeFlownBesideThoseThatCannot) {
    reports::Report report;
    report.flown.runs = threeContenders();
    report.summary = reports::summarize(report.flown.runs);
    report.worst_missing = {"the first cannot", "the second cannot"};
    EXPECT_THAT(reports::reportPage(report), Not(HasSubstr(replays::overheadLegend())));
    report.worst.push_back({report.flown.runs[0], true, {5, 0}, {45, 0}, {}, {}, {}});
    const std::string page = reports::reportPage(report);
    EXPECT_THAT(page, HasSubstr(replays::overheadLegend()));
    EXPECT_THAT(page, HasSubstr("Flown again from their seeds"));
    EXPECT_THAT(page, HasSubstr("<p>the first cannot</p>\n<p>the second cannot</p>"));
}

TEST(Pages, ChartsOfAReportHaveTheirPlacesAndTheirData) {
    reports::Report report;
    report.flown.runs = threeContenders();
    report.summary = reports::summarize(report.flown.runs);
    const auto hasPlace = [](const std::string& page, const std::string& chart) {
        return page.find("id=\"chart-" + chart + "\"") != std::string::npos;
    };
    EXPECT_FALSE(hasPlace(reports::reportPage(report), "memory"));
    report.memory = {{"W-RoI", {{0, 1e6}, {500, 2.5e6}}}};
    const std::string page = reports::reportPage(report);
    for (const char* chart : {"success", "clearance", "command", "memory"}) {
        EXPECT_TRUE(hasPlace(page, chart)) << chart;
    }
    const std::string before = "id=\"data\">";
    const std::size_t begin = page.find(before) + before.size();
    const auto data =
        nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
    EXPECT_EQ(data["memory"][0]["megabytes_by_m"],
              nlohmann::json::parse("[[0.0, 1.0], [500.0, 2.5]]"));
    EXPECT_EQ(data["latencies"][0]["courses"], 10);
    EXPECT_EQ(data["latencies"][0]["bars"][1]["p95_ms"], 6.0);
    // Clearances of the ten courses are 0, 0.1 ... 0.9 m.
    const auto& quantiles_m = data["clearances"][0]["curves"][0]["quantiles_m"];
    ASSERT_EQ(quantiles_m.size(), 51u);
    for (std::size_t i = 0; i <= 50; ++i) {
        EXPECT_NEAR(quantiles_m[i].get<double>(), 0.9 * static_cast<double>(i) / 50, 1e-9);
    }
}

TEST(Pages, EveryWorldModelHasAColourOfItsOwn) {
    reports::Report report;
    report.flown.runs = threeContenders();
    report.summary = reports::summarize(report.flown.runs);
    const std::string script = reports::reportPage(report);
    std::set<std::string> colours;
    for (const std::string& model : avoidance::worldModelNames()) {
        const std::string before = "'" + model + "': ['";
        const std::size_t at = script.find(before);
        ASSERT_NE(at, std::string::npos) << model;
        EXPECT_TRUE(colours.insert(script.substr(at + before.size(), 7)).second) << model;
    }
}

TEST(Pages, AModelOfAnotherVersionHasNoStages) {
    reports::Report report;
    report.flown.runs = threeContenders();
    report.flown.runs.push_back(test::runOf("gap", 0, "Q-Full", "astar", test::kWon));
    report.summary = reports::summarize(report.flown.runs);
    report.profile = trials::constantProfile(1);
    EXPECT_THAT(reports::reportPage(report), HasSubstr("Q-Full"));
}

TEST(WorstRuns, AreCollisionsThenTimeoutsThenByClearanceOneOfAKind) {
    std::vector<Row> runs = threeContenders();
    runs.push_back(test::runOf("gap", 0, "oracle", "astar", kHit));
    runs.push_back(test::runOf("street", 1, "W-RoI", "astar", kHit));
    const std::vector<Row> worst = replays::worstRuns(runs, 3);
    ASSERT_EQ(worst.size(), 3u);
    EXPECT_EQ(worst[0].scenario + worst[0].setup.model, "gapW-RoI");
    EXPECT_EQ(worst[1].scenario, "street");
    EXPECT_EQ(worst[2].setup.model, "O-Full-0.4");
    EXPECT_TRUE(replays::worstRuns({}, 6).empty());
}

TEST(Pages, FillTheirPlacesAndEscapeWhatTheyAreTold) {
    EXPECT_EQ(pages::filled("a{{x}}b{{y}}", {{"x", "{{y}}"}, {"y", "2"}}), "a{{y}}b2");
    EXPECT_THROW(pages::filled("{{z}}", {}), std::logic_error);
    EXPECT_EQ(pages::scriptText("\"</script>\""), "\"\\u003c/script>\"");
    EXPECT_EQ(pages::scriptText("\"<!--<script>\""), "\"\\u003c!--\\u003cscript>\"");
    EXPECT_EQ(nlohmann::json::parse(pages::scriptText("\"<<!--\"")), "<<!--");
    EXPECT_EQ(pages::htmlText("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
    EXPECT_EQ(pages::figure(-0.001, 2), "0.00");
    EXPECT_EQ(pages::figure(NAN, 2), "-");
    EXPECT_EQ(reports::percentOf(0, 200), "0.0 (0.0 to 1.9)");
    EXPECT_EQ(pages::markdownOf({{"a", "b"}, {{"1", "2"}}}), "| a | b |\n|---|--:|\n| 1 | 2 |\n");
    EXPECT_EQ(pages::markdownOf({{"a|b"}, {{"c\\|d\ne"}}}), "| a\\|b |\n|---|\n| c\\\\\\|d e |\n");
}

}  // namespace
}  // namespace hagen
