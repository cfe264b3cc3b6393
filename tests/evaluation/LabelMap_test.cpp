#include <gmock/gmock.h>
#include <hagen/evaluation/LabelMap.h>

#include "support/Program.h"

namespace hagen::evaluation {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;

class LabelMapFile : public testing::Test {
 protected:
    void expectRefused(const std::string& text, const std::string& words) const {
        const std::string message =
            test::messageOf([&] { readLabelMap(folder_.write("map.yaml", text)); });
        EXPECT_THAT(message, HasSubstr(words));
        EXPECT_THAT(message, HasSubstr("map.yaml"));
    }
    test::TemporaryFolder folder_;
};

TEST_F(LabelMapFile, ReadsNamesAndLabels) {
    const LabelMap map = readLabelMap(folder_.write(
        "map.yaml",
        "# kinds\n70: {name: vegetation, label: 2}\n72:\n  name: terrain\n  label: 1\n"));
    ASSERT_EQ(map.size(), 2u);
    EXPECT_EQ(map.at(70).name, "vegetation");
    EXPECT_EQ(map.at(70).label, Label::Roi);
    EXPECT_EQ(map.at(72).label, Label::Rou);
}

TEST_F(LabelMapFile, MapsClassesToLabels) {
    const LabelMap map{{0, {"nothing", Label::Unclassified}}, {70, {"vegetation", Label::Roi}}};
    EXPECT_EQ(labelsOfClasses({70, 0}, map), (std::vector<Label>{Label::Roi, Label::Unclassified}));
    EXPECT_EQ(labelsOfNumbers({2, 1, 0}),
              (std::vector<Label>{Label::Roi, Label::Rou, Label::Unclassified}));
}

TEST_F(LabelMapFile, ShippedMapsDifferInVegetation) {
    const fs::path config = fs::path(HAGEN_SOURCE_DIR) / "config";
    LabelMap with = readLabelMap(config / "semantic_kitti.yaml");
    const LabelMap without = readLabelMap(config / "semantic_kitti_without_vegetation.yaml");
    ASSERT_EQ(with.size(), without.size());
    EXPECT_EQ(with.at(70).label, Label::Roi);
    with.at(70).label = Label::Unclassified;
    for (const auto& [number, kind] : with) {
        EXPECT_EQ(without.at(number).label, kind.label) << number;
        EXPECT_EQ(without.at(number).name, kind.name) << number;
    }
}

TEST_F(LabelMapFile, RejectsInvalidFiles) {
    expectRefused("70: vegetation", "map.yaml:1: expected name and label");
    expectRefused("70: {name: vegetation}", "expected name and label");
    expectRefused("70: {name: vegetation, label: 2, colour: green}", "name and label");
    expectRefused("40: {name: road, label: 1}\n70: {name: tree, label: 3}",
                  "map.yaml:2: label '3' is not 0");
    expectRefused("tree: {name: tree, label: 2}", "'tree' is not a class number");
    expectRefused("70000: {name: tree, label: 2}", "'70000' is not a class number");
    expectRefused("7: {name: a, label: 2}\n7: {name: b, label: 1}", "map.yaml:2: '7' occurs twice");
    expectRefused("7: {name: a, label: 2}\n8: {name: a, label: 1}", "two classes are named 'a'");
    expectRefused("[1, 2]", "expected lines such as '70: {name: vegetation, label: 2}'");
    expectRefused("", "expected lines such as");
    expectRefused("7: {name", "not YAML");
    EXPECT_THAT(test::messageOf([] { readLabelMap("none.yaml"); }),
                HasSubstr("none.yaml: no such file"));
}

TEST_F(LabelMapFile, ReportsMissingClasses) {
    const auto expectError = [](auto call, const std::string& words) {
        EXPECT_THAT(call, testing::ThrowsMessage<std::invalid_argument>(HasSubstr(words)));
    };
    expectError([] { labelsOfClasses({71}, {}); }, "class 71 is not in");
    expectError([] { labelsOfNumbers({40}); }, "label 40 is not 0");
}

}  // namespace
}  // namespace hagen::evaluation
