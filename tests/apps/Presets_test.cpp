// Presets by name, in all programs that accept settings.
#include "support/SegmentTest.h"

namespace hagen {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;

class Presets : public test::SegmentTest {
 protected:
    static void expectRejected(const char* program, const Arguments& arguments, const char* words) {
        const auto outcome = test::run(program, arguments);
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_THAT(outcome.err, HasSubstr(words));
    }
};

TEST_F(Presets, NameSelectsPresetFile) {
    for (const std::string name : {"vlp16", "hdl64e", "mid360", "paper"}) {
        EXPECT_EQ(expectSuccess({"--config-dump", "-c", name}).out,
                  run({"--config-dump", "-c", config(name)}).out);
    }
}

TEST_F(Presets, AreFoundBesideMovedProgram) {
    fs::create_directories(folder_ / "moved/bin");
    folder_.write("moved/share/hagen/config/vlp16.yaml", "zone_m: 17\n");
    fs::copy_file(HAGEN_RAWLOG_SEGMENT, folder_ / "moved/bin/rawlog-segment");
    const auto outcome =
        test::run(path("moved/bin/rawlog-segment"), {"--config-dump", "-c", "vlp16"});
    EXPECT_THAT(outcome.out, HasSubstr("zone_m: 17 "));
}

TEST_F(Presets, RejectsUnknownNames) {
    const std::string folder = HAGEN_SOURCE_DIR "/config";
    expectFailure({"-i", folder, "-o", path("out.rawlog"), "-c", "vlp61"}, 2,
                  "vlp61: no such file or preset; did you mean 'vlp16'?");
    expectRejected(HAGEN_SEGMENTATION_EVALUATE, {"-i", folder, "-c", "vlp61"},
                   "did you mean 'vlp16'?");
    expectRejected(
        HAGEN_OCTOMAP_COMPARE,
        {"openloop", "-i", recording(), "--models", "W-RoI", "-c", "vlp61", "-o", path("models")},
        "did you mean 'vlp16'?");
    expectRejected(HAGEN_SEGMENTATION_EVALUATE, {"-i", folder, "--camera", "backward"},
                   "presets: camera_forward;");
    expectRejected(HAGEN_SEGMENTATION_EVALUATE, {"-i", folder, "--label-map", "kitti"},
                   "presets: semantic_kitti, semantic_kitti_without_vegetation;");
}

}  // namespace
}  // namespace hagen
