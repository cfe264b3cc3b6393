#include "evaluation/labelled_folders/LabelledFolders.h"
#include <gmock/gmock.h>
#include <hagen/settings/Settings.h>

#include "support/Program.h"

namespace hagen::evaluation {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class LabelledFolders : public testing::Test {
 protected:
    /// Writes a folder with one scan of one return.
    std::string folderAt(const std::string& path) const {
        folder_.write(path + "/velodyne/000000.bin", std::string(16, '\0'));
        folder_.write(path + "/labels/000000.label", std::string(4, '\0'));
        return (folder_ / path).string();
    }
    static std::vector<std::string> namesOf(const std::vector<std::string>& folders) {
        MethodSet methods;
        methods.filter.emplace_back();
        methods.filter.front().settings.sensor.model = "VLP-16";
        std::vector<std::string> names;
        for (const auto& source : sourcesOf(folders, methods, {})) names.push_back(source->name());
        return names;
    }

    test::TemporaryFolder folder_;
};

TEST_F(LabelledFolders, HaveShortestUniqueNames) {
    const std::string a = folderAt("x/beams16/00"), b = folderAt("x/beams64/00"),
                      c = folderAt("y/beams64/00"), d = folderAt("z/01");
    EXPECT_THAT(namesOf({a}), ElementsAre("00"));
    EXPECT_THAT(namesOf({a, d}), ElementsAre("00", "01"));
    EXPECT_THAT(namesOf({b, a}), ElementsAre("beams64/00", "beams16/00"));
    EXPECT_THAT(namesOf({a, b, c + "/"}),
                ElementsAre("x/beams16/00", "x/beams64/00", "y/beams64/00"));
    EXPECT_THAT(test::messageOf([&] { namesOf({a, d, a + "/."}); }), HasSubstr("is given twice"));
}

/// Ground truth and filter use the same mount.
TEST_F(LabelledFolders, UseMountWithoutPoses) {
    const std::string folder = folderAt("hanging");
    MethodSet methods;
    methods.filter.emplace_back();
    methods.filter.front().settings.sensor.model = "VLP-16";
    const auto upOf = [&] {
        const auto scan = sourcesOf({folder}, methods, {}).front()->next();
        return Eigen::Vector3f(scan->levelFromSensor().row(2));
    };
    EXPECT_LT((upOf() - Eigen::Vector3f::UnitZ()).norm(), 1e-6f);
    folder_.write("hanging/sensor.yaml", "sensor: {model: VLP-16, mount_roll_deg: 180}");
    EXPECT_LT((upOf() + Eigen::Vector3f::UnitZ()).norm(), 1e-6f);
    folder_.write("hanging/times.txt", "100\n");
    folder_.write("hanging/poses.tum", "100 0 0 2 0 0 0 1\n");  // sensor poses take precedence
    EXPECT_LT((upOf() - Eigen::Vector3f::UnitZ()).norm(), 1e-6f);
}

}  // namespace
}  // namespace hagen::evaluation
