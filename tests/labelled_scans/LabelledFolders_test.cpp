#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/labelled_scans/LabelledFolders.h>
#include <hagen/settings/Settings.h>

#include <string>
#include <vector>

#include "support/Program.h"

namespace hagen::labelled_scans {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class LabelledFolders : public testing::Test {
 protected:
    /// A folder with one scan of one return.
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

TEST_F(LabelledFolders, HaveTheShortestNamesThatDiffer) {
    const std::string a = folderAt("x/beams16/00"), b = folderAt("x/beams64/00"),
                      c = folderAt("y/beams64/00"), d = folderAt("z/01");
    EXPECT_THAT(namesOf({a}), ElementsAre("00"));
    EXPECT_THAT(namesOf({a, d}), ElementsAre("00", "01"));
    EXPECT_THAT(namesOf({b, a}), ElementsAre("beams64/00", "beams16/00"));
    EXPECT_THAT(namesOf({a, b, c + "/"}),
                ElementsAre("x/beams16/00", "x/beams64/00", "y/beams64/00"));
    EXPECT_THAT(test::messageOf([&] { namesOf({a, d, a + "/."}); }), HasSubstr("is given twice"));
}

}  // namespace
}  // namespace hagen::labelled_scans
