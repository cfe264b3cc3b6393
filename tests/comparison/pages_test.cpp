// Pages: their places, and the runs from above.
#include <gtest/gtest.h>
#include <cmath>
#include <stdexcept>

#include <hagen/pages/Page.h>
#include <hagen/pages/Table.h>
#include <hagen/replays/Overhead.h>
#include <hagen/reports/Figures.h>
#include <hagen/reports/Report.h>
#include "SampleRuns.h"

namespace hagen {
namespace {

using namespace test;

TEST(Overhead, ShowsTheWholeFlightAndMarksItsEnds) {
    replays::OverheadView view{
        test::runOf("gap", 0, "W-RoI", "astar", kHit), true, {5, 0}, {45, 0}, {}, {}, {}};
    view.track_m = {{5, 0}, {20, 30}};
    const std::string hit = replays::svgOf(view);
    // 5 m around 5 to 45 and 0 to 30, and half as wide again as high: 60 x 40.
    EXPECT_NE(hit.find("viewBox=\"-5.0 -35.0 60.0 40.0\""), std::string::npos) << hit;
    EXPECT_NE(hit.find("class=\"hit\""), std::string::npos);
    EXPECT_EQ(hit.find("class=\"end\""), std::string::npos);
    view.run.result.outcome = kLate;
    EXPECT_NE(replays::svgOf(view).find("class=\"end\""), std::string::npos);
    view.track_m.clear();  // a straight way is shown with what is beside it
    EXPECT_NE(replays::svgOf(view).find("viewBox=\"0.0 -16.7 50.0 33.3\""), std::string::npos);
    for (const char* mark : {"start", "goal", "end", "hit", "stop", "track", "obstacles"}) {
        EXPECT_NE(replays::overheadLegend().find("class=\"" + std::string(mark) + "\""),
                  std::string::npos)
            << mark;
    }
}

TEST(Pages, ShowTheWorstRunsThatCanBeFlownBesideThoseThatCannot) {
    reports::Report report;
    report.flown.runs = threeContenders();
    report.summary = reports::summarize(report.flown.runs);
    report.worst_missing = {"the first cannot", "the second cannot"};
    EXPECT_EQ(reports::reportPage(report).find(replays::overheadLegend()), std::string::npos);
    report.worst.push_back({report.flown.runs[0], true, {5, 0}, {45, 0}, {}, {}, {}});
    const std::string page = reports::reportPage(report);
    EXPECT_NE(page.find(replays::overheadLegend()), std::string::npos);
    EXPECT_NE(page.find("Flown again from their seeds"), std::string::npos);
    EXPECT_NE(page.find("<p>the first cannot</p>\n<p>the second cannot</p>"), std::string::npos);
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
    EXPECT_EQ(pages::scriptText("\"</script>\""), "\"<\\/script>\"");
    EXPECT_EQ(pages::htmlText("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
    EXPECT_EQ(pages::figure(-0.001, 2), "0.00");
    EXPECT_EQ(pages::figure(NAN, 2), "-");
    EXPECT_EQ(reports::percentOf(0, 200), "0.0 (0.0 to 1.9)");
    EXPECT_EQ(pages::markdownOf({{"a", "b"}, {{"1", "2"}}}), "| a | b |\n|---|--:|\n| 1 | 2 |\n");
}

}  // namespace
}  // namespace hagen
