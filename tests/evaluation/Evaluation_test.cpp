#include <gmock/gmock.h>
#include <hagen/evaluation/Evaluation.h>

#include "evaluation/Labels.h"
#include "support/Program.h"

namespace hagen::evaluation {
namespace {

using testing::HasSubstr;

std::vector<Method> allRoiAndAllRou() {
    const auto all = [](Label label) {
        return [label](const ScanInput& input) {
            return std::vector<Label>(input.scan.size(), label);
        };
    };
    return {{"all RoI", all(O)}, {"all ROU", all(G)}};
}

/// Scans of `returns` obstacles, 1 m apart along x.
class Obstacles : public LabelledScanSource {
 public:
    Obstacles(std::string name, std::vector<int> returns, std::vector<Method> methods)
        : name_(std::move(name)), returns_(std::move(returns)), methods_(std::move(methods)) {}

    std::optional<GroundTruthScan> next() override {
        if (next_ == returns_.size()) return std::nullopt;
        GroundTruthScan scan;
        scan.name = name_ + "/" + std::to_string(next_);
        for (int r = 1; r <= returns_[next_]; ++r)
            scan.input.scan.x_m.push_back(static_cast<float>(r));
        scan.input.scan.range_m = scan.input.scan.x_m;
        scan.input.scan.y_m.assign(scan.input.scan.size(), 0);
        scan.input.scan.z_m = scan.input.scan.y_m;
        scan.truth.assign(scan.input.scan.size(), O);
        ++next_;
        return scan;
    }
    const std::string& name() const override { return name_; }
    std::size_t size() const override { return returns_.size(); }
    const LabelMap& kinds() const override { return kinds_; }
    SensorModel sensor() const override { return sensorModel("VLP-16"); }
    std::vector<Method> makeMethods() const override { return methods_; }

 private:
    std::string name_;
    std::vector<int> returns_;
    std::vector<Method> methods_;
    LabelMap kinds_;
    std::size_t next_ = 0;
};

/// Converts sources to the argument of evaluate().
template <class... Source>
LabelledScanSources sourcesOf(Source... source) {
    LabelledScanSources sources;
    (sources.push_back(std::make_unique<Source>(std::move(source))), ...);
    return sources;
}

Obstacles obstacles(const std::string& name, const std::vector<int>& returns,
                    const std::vector<Method>& methods = allRoiAndAllRou()) {
    return Obstacles(name, returns, methods);
}

TEST(Evaluation, ScoresEachMethodPerScan) {
    const auto methods = evaluate(sourcesOf(obstacles("a", {3, 2}), obstacles("b", {4})));
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

TEST(Evaluation, ScoresNearestReturnPerPixel) {
    EvaluationOptions options;
    options.camera = PinholeCamera{8, 8, 4, 4, 4, 4, Eigen::Isometry3d::Identity()};
    const auto methods = evaluate(sourcesOf(obstacles("a", {3})), options);  // one behind the other
    ASSERT_EQ(methods[0].pixels.size(), 1u);
    EXPECT_EQ(methods[0].pixels[0].all.returns(), 1);
    EXPECT_EQ(methods[0].returns[0].all.returns(), 3);
}

TEST(Evaluation, CallsListenerPerScanAndMethod) {
    std::vector<std::string> seen;
    evaluate(sourcesOf(obstacles("a", {1, 2})), {}, [&](const MethodOutput& view) {
        seen.push_back(view.method_name + std::to_string(view.scan) + ":" +
                       std::to_string(view.found.size()));
    });
    EXPECT_EQ(seen,
              (std::vector<std::string>{"all RoI0:1", "all ROU0:1", "all RoI1:2", "all ROU1:2"}));
}

TEST(Evaluation, ReportsScanWithWrongLabels) {
    int calls = 0;  // first scan twice, then the second
    const Method one_too_few{"short", [&calls](const ScanInput& input) {
                                 return std::vector<Label>(++calls == 3 ? 1 : input.scan.size(), O);
                             }};
    const std::string message = test::messageOf([&] {
        evaluate(sourcesOf(obstacles("a", {2, 2}, {one_too_few})));
    });
    EXPECT_THAT(message, HasSubstr("a/1: "));
    EXPECT_THAT(message, HasSubstr("the numbers of found labels (1) and returns (2) differ"));
}

TEST(Evaluation, ReadsRecordedLabelsOnceUntimed) {
    int calls = 0;
    const Method recorded{"theirs",
                          [&calls](const ScanInput& input) {
                              ++calls;
                              return std::vector<Label>(input.scan.size(), O);
                          },
                          true};
    const auto methods = evaluate(sourcesOf(obstacles("a", {2, 2}, {recorded})));
    EXPECT_EQ(calls, 2);
    EXPECT_EQ(methods[0].returns[1].all.roi.hits, 2);
    EXPECT_TRUE(methods[0].latency_ms.empty());
}

TEST(Evaluation, RejectsConsumedSources) {
    const LabelledScanSources sources = sourcesOf(obstacles("a", {2, 2}));
    evaluate(sources);
    EXPECT_THROW(evaluate(sources), std::invalid_argument);
}

TEST(Evaluation, RejectsMissingOrDifferingSources) {
    EXPECT_THROW(evaluate(LabelledScanSources()), std::invalid_argument);
    const Method another{"another", [](const ScanInput&) { return std::vector{O}; }};
    EXPECT_THROW(evaluate(sourcesOf(obstacles("a", {1}), obstacles("b", {1}, {another}))),
                 std::invalid_argument);
}

}  // namespace
}  // namespace hagen::evaluation
