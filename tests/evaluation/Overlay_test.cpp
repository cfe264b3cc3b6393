#include "evaluation/labelled_folders/Overlay.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/Program.h"

namespace hagen::evaluation {
namespace {

TEST(Overlay, WritesOneFolderPerMethod) {
    const test::TemporaryFolder folder;
    GroundTruthScan truth;
    truth.name = "scans/velodyne/000007.bin";
    truth.input.scan.range_m = {5, 6};
    truth.truth = {Label::Roi, Label::Rou};
    std::vector<CameraPixel> pixels(2);
    pixels[1].index = 1;
    EvaluationOptions options;
    options.camera.emplace();
    options.camera->width_px = options.camera->height_px = 32;
    const std::string name = "beta/5";
    for (const std::size_t methods : {1, 2}) {
        drawOverlay(folder / "pictures", "x/00",
                    {0, 0, 0, methods, name, truth, truth.truth, pixels}, options);
    }
    EXPECT_TRUE(std::filesystem::exists(folder / "pictures/x_00_000007_overlay.png"));
    EXPECT_TRUE(std::filesystem::exists(folder / "pictures/beta_5/x_00_000007_overlay.png"));

    const std::string same = "beta_5", above = "..";
    const auto errorOf = [&](const std::string& method, const std::string& source) {
        return test::messageOf([&] {
            drawOverlay(folder / "pictures", source,
                        {0, 0, 0, 2, method, truth, truth.truth, pixels}, options);
        });
    };
    const std::string twice = "two pictures would have the name beta_5/x_00_000007_overlay.png";
    EXPECT_THAT(errorOf(same, "x/00"), testing::HasSubstr(twice));
    EXPECT_THAT(errorOf(name, "x_00"), testing::HasSubstr(twice));
    EXPECT_EQ(errorOf(above, "x/00"), "");
    EXPECT_TRUE(std::filesystem::exists(folder / "pictures/_/x_00_000007_overlay.png"));
}

}  // namespace
}  // namespace hagen::evaluation
