#include "convert/pictures/StagePictures.h"
#include "convert/pictures/Gnuplot.h"

#include <stdexcept>
#include <string>

#include "convert/pictures/StageData.h"
#include "convert/pictures/StagePanels.h"

namespace hagen::convert {
namespace {

constexpr int kWidth_px = StagePanelWriter::kWidth_px;

void depthPicture(StagePanelWriter& panels) {
    panels.beginPicture("1_depth.png", "1  depth image (III-A)", 330);
    panels.depthImage({84, kWidth_px - 105, 60, 270}, "$depth", true);
    panels.endPicture();
}

void maximaPicture(StagePanelWriter& panels) {
    panels.beginPicture("2_maxima.png", "2  persistent maxima of proximity (III-B)", 860);
    panels.maximaImage({84, kWidth_px - 105, 590, 800}, true);
    panels.barcode({84, kWidth_px - 105, 60, 480});
    panels.endPicture();
}

void mergedPicture(StagePanelWriter& panels) {
    panels.beginPicture("3_merged.png", "3  maxima sharpened and merged (III-B)", 660);
    panels.depthImage({84, kWidth_px - 105, 390, 600}, "$merged", true);
    panels.angleBefore({84, 570, 60, 270});
    panels.angleAfter({650, kWidth_px - 60, 60, 270});
    panels.endPicture();
}

void rangeAnglePicture(StagePanelWriter& panels) {
    panels.beginPicture("4_range_angle.png", "4  range angle image (III-C)", 330);
    panels.angleImage({84, kWidth_px - 105, 60, 270}, "$angle", true, false);
    panels.endPicture();
}

void smoothedPicture(StagePanelWriter& panels) {
    panels.beginPicture("5_smoothed.png", "5  singular spectrum analysis (III-D)", 860);
    panels.angleImage({84, kWidth_px - 105, 590, 800}, "$smoothed", true, true);
    panels.series({84, 560, 60, 460});
    panels.components({760, kWidth_px - 30, 60, 460});
    panels.endPicture();
}

void labelPicture(StagePanelWriter& panels) {
    panels.beginPicture("6_labels.png", "6  regions of interest (III-E)", 660);
    panels.labelImage({84, kWidth_px - 105, 390, 580}, true);
    panels.zoomLabels({84, kWidth_px - 105, 60, 270});
    panels.endPicture();
}

void topPicture(StagePanelWriter& panels) {
    panels.beginPicture("7_top_view.png", "7  the returns from above", 960, 900);
    panels.topView({70, 880, 60, 870}, true);
    panels.endPicture();
}

void overview(StagePanelWriter& panels) {
    const int height = 1540;
    panels.beginPicture("stages.png", "Stages of the segmentation", height);
    const auto row = [&](int number) {
        const double top = height - 64.0 - 134.0 * number;
        return Box{84, kWidth_px - 105, top - 98, top};
    };
    panels.panelTitle("1  depth image (III-A)");
    panels.depthImage(row(0), "$depth", false);
    panels.panelTitle("2  persistent maxima of proximity (III-B)");
    panels.maximaImage(row(1), false);
    panels.panelTitle("3  maxima sharpened and merged (III-B)");
    panels.depthImage(row(2), "$merged", false);
    panels.panelTitle("4  range angle image (III-C)");
    panels.angleImage(row(3), "$angle", false, false);
    panels.panelTitle("5  smoothed by singular spectrum analysis (III-D)");
    panels.angleImage(row(4), "$smoothed", false, true);
    panels.panelTitle("6  regions of interest (III-E)");
    panels.labelImage(row(5), true);
    panels.panelTitle("2  ");
    panels.barcode({84, 540, 390, 600});
    panels.panelTitle("5  ");
    panels.components({150, 540, 60, 290});
    panels.panelTitle("7  the returns from above");
    panels.topView({640, 1180, 60, 600}, false);
    panels.endPicture();
}

}  // namespace

const std::vector<std::string>& stagePictures() {
    static const std::vector<std::string> kNames{
        "1_depth.png",    "2_maxima.png", "3_merged.png",   "4_range_angle.png",
        "5_smoothed.png", "6_labels.png", "7_top_view.png", "stages.png"};
    return kNames;
}

const base::OutputKind kStagePictures{
    "a folder of pictures", [](const std::filesystem::path& within) {
        const auto& pictures = stagePictures();
        return std::find(pictures.begin(), pictures.end(), within.filename()) != pictures.end();
    }};

void drawStages(const StageView& view, const std::filesystem::path& folder) {
    if (view.result.labels.rows() != view.sensor.rows()) {
        throw std::invalid_argument(
            "drawStages: images of " + std::to_string(view.result.labels.rows()) +
            " rows do not match a sensor with " + std::to_string(view.sensor.rows()) + " beams");
    }
    const StageData data = stageDataOf(view);
    StagePanelWriter panels(view, data);
    depthPicture(panels);
    maximaPicture(panels);
    mergedPicture(panels);
    rangeAnglePicture(panels);
    smoothedPicture(panels);
    labelPicture(panels);
    topPicture(panels);
    overview(panels);
    runGnuplot(panels.script(), folder, stagePictures());
}

}  // namespace hagen::convert
