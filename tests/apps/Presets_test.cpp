// Presets by name, in every program that takes settings.
#include <sstream>

#include "support/ProgramTest.h"

namespace hagen {
namespace {

using testing::AllOf;
using testing::HasSubstr;

namespace fs = std::filesystem;
const std::string kConfig = HAGEN_SOURCE_DIR "/config/";

class Presets : public test::ProgramTest {
 protected:
    test::Outcome run(const std::vector<std::string>& arguments) const override {
        return test::run(HAGEN_RAWLOG_SEGMENT, arguments);
    }
};

TEST_F(Presets, ANameIsTheFile) {
    for (const std::string name : {"vlp16", "hdl64e", "mid360", "paper"}) {
        const auto by_name = run({"--config-dump", "-c", name});
        EXPECT_EQ(by_name.exit_code, 0) << by_name.err;
        EXPECT_EQ(by_name.out, run({"--config-dump", "-c", kConfig + name + ".yaml"}).out);
    }
}

TEST_F(Presets, AProgramThatWasMovedTakesItsPresetsAlong) {
    fs::create_directories(folder_ / "moved/bin");
    folder_.write("moved/share/hagen/config/vlp16.yaml", "zone_m: 17\n");
    fs::copy_file(HAGEN_RAWLOG_SEGMENT, folder_ / "moved/bin/rawlog-segment");
    const auto outcome =
        test::run(path("moved/bin/rawlog-segment"), {"--config-dump", "-c", "vlp16"});
    EXPECT_THAT(outcome.out, HasSubstr("zone_m: 17 "));
}

TEST_F(Presets, AnUnknownOneIsWrongUsageOfEveryProgram) {
    expectFailure({"-i", kConfig, "-o", path("out.rawlog"), "-c", "vlp61"}, 2,
                  "vlp61: no such file or preset; did you mean 'vlp16'?");
    const auto evaluate = test::run(HAGEN_SEGMENTATION_EVALUATE, {"-i", kConfig, "-c", "vlp61"});
    EXPECT_EQ(evaluate.exit_code, 2);
    EXPECT_THAT(evaluate.err, HasSubstr("did you mean 'vlp16'?"));
    const auto openloop = test::run(HAGEN_OCTOMAP_COMPARE,
                                    {"openloop", "-i", HAGEN_SOURCE_DIR "/rawlogs/orchard.rawlog",
                                     "--models", "W-RoI", "-c", "vlp61", "-o", path("models")});
    EXPECT_EQ(openloop.exit_code, 2);
    EXPECT_THAT(openloop.err, HasSubstr("did you mean 'vlp16'?"));
}

TEST_F(Presets, FlagsListThoseOfTheirKind) {
    const auto camera =
        test::run(HAGEN_SEGMENTATION_EVALUATE, {"-i", kConfig, "--camera", "backward"});
    EXPECT_EQ(camera.exit_code, 2);
    EXPECT_THAT(camera.err, AllOf(HasSubstr("presets: camera_forward;"), HasSubstr("backward")));
    const auto map =
        test::run(HAGEN_SEGMENTATION_EVALUATE, {"-i", kConfig, "--label-map", "kitti"});
    EXPECT_EQ(map.exit_code, 2);
    EXPECT_THAT(map.err, HasSubstr("presets: semantic_kitti, semantic_kitti_without_vegetation;"));
}

}  // namespace
}  // namespace hagen
