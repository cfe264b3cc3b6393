#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/evaluation/Evaluation.h>

#include <stdexcept>

#include "support/Program.h"

namespace hagen::evaluation {
namespace {

using testing::HasSubstr;

constexpr auto G = Label::Rou, O = Label::Roi;

/// Scans of `returns` obstacles, 1 m apart along x.
LabelledScanSource obstacles(const std::string& name, const std::vector<int>& returns) {
    LabelledScanSource source;
    source.name = name;
    source.scans = returns.size();
    source.read = [returns](std::size_t i) {
        GroundTruthScan scan;
        for (int r = 1; r <= returns[i]; ++r) scan.input.scan.x_m.push_back(static_cast<float>(r));
        scan.input.scan.range_m = scan.input.scan.x_m;
        scan.input.scan.y_m.assign(scan.input.scan.size(), 0);
        scan.input.scan.z_m = scan.input.scan.y_m;
        scan.truth.assign(scan.input.scan.size(), O);
        return scan;
    };
    source.scanName = [name](std::size_t i) { return name + "/" + std::to_string(i); };
    source.makeMethods = [] {
        const auto all = [](Label label) {
            return [label](const ScanInput& input) {
                return std::vector<Label>(input.scan.size(), label);
            };
        };
        return std::vector<Method>{{"all RoI", all(O)}, {"all ROU", all(G)}};
    };
    return source;
}

TEST(Evaluation, ScoresEachMethodOnEachScan) {
    const auto methods = evaluate({obstacles("a", {3, 2}), obstacles("b", {4})});
    ASSERT_EQ(methods.size(), 2u);
    EXPECT_EQ(methods[0].name, "all RoI");
    ASSERT_EQ(methods[0].returns.size(), 3u);
    EXPECT_EQ(methods[0].returns[0].all.roi.hits, 3);
    EXPECT_EQ(methods[0].returns[2].all.roi.hits, 4);
    EXPECT_EQ(methods[0].returns[2].folder, 1u);
    EXPECT_EQ(methods[1].returns[1].all.roi.misses, 2);
    EXPECT_EQ(methods[1].latency_ms.size(), 3u);
    EXPECT_TRUE(methods[0].pixels.empty());
}

TEST(Evaluation, OverPixelsTheNearestReturnCounts) {
    EvaluationOptions options;
    options.camera = PinholeCamera{8, 8, 4, 4, 4, 4, Eigen::Isometry3d::Identity()};
    const auto methods = evaluate({obstacles("a", {3})}, options);  // one behind the other
    ASSERT_EQ(methods[0].pixels.size(), 1u);
    EXPECT_EQ(methods[0].pixels[0].all.returns(), 1);
    EXPECT_EQ(methods[0].returns[0].all.returns(), 3);
}

TEST(Evaluation, ShowsEachScanOfEachMethod) {
    std::vector<std::string> seen;
    evaluate({obstacles("a", {1, 2})}, {}, [&](const MethodOutput& view) {
        seen.push_back(view.method_name + std::to_string(view.scan) + ":" +
                       std::to_string(view.found.size()));
    });
    EXPECT_EQ(seen,
              (std::vector<std::string>{"all RoI0:1", "all ROU0:1", "all RoI1:2", "all ROU1:2"}));
}

TEST(Evaluation, NamesTheScanWhoseLabelsDoNotFit) {
    LabelledScanSource source = obstacles("a", {2, 2});
    source.makeMethods = [] {
        int calls = 0;  // the first scan twice, then the second
        return std::vector<Method>{{"short", [calls](const ScanInput& input) mutable {
                                        return std::vector<Label>(
                                            ++calls == 3 ? 1 : input.scan.size(), O);
                                    }}};
    };
    const std::string message = test::messageOf([&] { evaluate({source}); });
    EXPECT_THAT(message, HasSubstr("a/1: "));
    EXPECT_THAT(message, HasSubstr("1 found labels for 2 returns"));
}

TEST(Evaluation, RefusesNoSourceAndSourcesThatDiffer) {
    EXPECT_THROW(evaluate({}), std::invalid_argument);
    LabelledScanSource other = obstacles("b", {1});
    other.makeMethods = [] {
        return std::vector<Method>{{"another", [](const ScanInput&) { return std::vector{O}; }}};
    };
    EXPECT_THROW(evaluate({obstacles("a", {1}), other}), std::invalid_argument);
}

}  // namespace
}  // namespace hagen::evaluation
