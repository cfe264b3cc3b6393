#include <gmock/gmock.h>
#include <hagen/avoidance/LatencyProfile.h>
#include "avoidance/flights/Calibration.h"

#include "support/Program.h"

namespace hagen::avoidance {
namespace {

using testing::HasSubstr;

using test::messageOf;
using test::TemporaryFolder;

TEST(LatencyProfile, DrawsMatchQuantiles) {
    LatencyProfile profile;
    profile.quantiles_ms["a"] = {1, 2, 10};  // half the draws in 1..2, half in 2..10
    simulation::Random random(7);
    int low = 0;
    double sum = 0;
    for (int i = 0; i < 20000; ++i) {
        const double drawn = profile.draw_ms("a", random);
        EXPECT_GE(drawn, 1);
        EXPECT_LE(drawn, 10);
        if (drawn < 2) ++low;
        sum += drawn;
    }
    EXPECT_NEAR(low / 20000.0, 0.5, 0.02);
    EXPECT_NEAR(sum / 20000, 0.5 * 1.5 + 0.5 * 6, 0.05);
    EXPECT_EQ(profile.median_ms("a"), 2);
}

TEST(LatencyProfile, ComputesQuantiles) {
    EXPECT_TRUE(quantilesOf({}).empty());
    EXPECT_EQ(quantilesOf({3, 1, 2}, 3), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(quantilesOf({4}, 2), (std::vector<double>{4, 4}));
}

TEST(LatencyProfile, RoundTrips) {
    const TemporaryFolder folder;
    LatencyProfile profile = constantProfile(1.25);
    profile.machine = "a \"machine\"";
    profile.quantiles_ms["filter"] = {0, 0.001, 12.5};
    folder.write("p.json", textOf(profile));
    const LatencyProfile read = readLatencyProfile(folder / "p.json");
    EXPECT_EQ(read.quantiles_ms, profile.quantiles_ms);
    EXPECT_EQ(read.machine, profile.machine);
    EXPECT_EQ(textOf(read), textOf(profile));
}

TEST(LatencyProfile, StandardProfileIsComplete) {
    const LatencyProfile standard = standardLatencyProfile();
    for (const auto& [stage, quantiles] : constantProfile(1).quantiles_ms) {
        EXPECT_GT(standard.median_ms(stage), -1) << stage;
    }
}

TEST(LatencyProfile, ReportsMissingStage) {
    const LatencyProfile profile;
    EXPECT_THAT(messageOf([&] { profile.median_ms("W-RoI/update"); }),
                HasSubstr("\"W-RoI/update\""));
}

TEST(LatencyProfile, ReportsBrokenKey) {
    const TemporaryFolder folder;
    const auto messageFor = [&](const std::string& text) {
        const auto file = folder.write("p.json", text);
        const std::string message = messageOf([&] { readLatencyProfile(file); });
        EXPECT_EQ(message.find(file.string()), 0u) << message;
        return message;
    };
    const auto has = [](const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    };
    EXPECT_TRUE(has(messageFor("{"), "is not valid JSON: parse error at line 1"));
    EXPECT_TRUE(has(messageFor("{}"), "quantiles_ms"));
    EXPECT_TRUE(has(messageFor(R"({"quantiles_ms": {"filter": []}})"), "filter"));
    EXPECT_TRUE(has(messageFor(R"({"quantiles_ms": {"filter": [2, 1]}})"), "filter"));
    EXPECT_TRUE(has(messageFor(R"({"quantiles_ms": {"filter": [-1]}})"), "filter"));
    EXPECT_TRUE(has(messageFor(R"({"quantiles_ms": {"filter": ["1"]}})"), "filter"));
    EXPECT_TRUE(has(messageFor(R"({"quantiles_ms": {"filter": [1e12]}})"), "from 0 to 60000"));
    EXPECT_TRUE(has(messageFor(R"({"machine": 3, "quantiles_ms": {}})"), "machine"));
    EXPECT_NE(messageOf([&] { readLatencyProfile(folder / "none.json"); }), "");
}

}  // namespace
}  // namespace hagen::avoidance
