#include "convert/pictures/StagePictures.h"
#include "convert/pictures/Drawing.h"
#include "filter/RoiBoxes.h"
#include "filter/paper/SingularSpectrumAnalysis.h"

#include <hagen/scan/Angle.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

namespace hagen::convert {
namespace {

/// The longest contiguous segment of a column's angles; empty if shorter than the window.
struct Run {
    int first_row = 0, rows = 0;
};
Run longestSmoothedRun(const Image<float>& angles, int column, int window_size) {
    Run longest;
    const int rows = static_cast<int>(angles.rows());
    for (int row = 0, first = 0; row <= rows; ++row) {
        if (row < rows && hasValue(angles(row, column))) continue;
        if (row - first > longest.rows) longest = {first, row - first};
        first = row + 1;
    }
    return longest.rows >= window_size ? longest : Run();
}

int selectedColumn(const StageView& view) {
    const SegmentationResult& r = view.result;
    const int columns = static_cast<int>(r.labels.cols());
    const float azimuth_deg = view.azimuth_deg.value_or(0.0f);
    int chosen =
        nearestColumn(static_cast<float>(radians(std::remainder(azimuth_deg, 360.0f))), columns);
    if (view.azimuth_deg) return chosen;
    // Columns that are not smoothed come last.
    std::tuple best(true, std::numeric_limits<float>::infinity());
    for (int column = 0; column < columns; ++column) {
        const bool is_unchanged =
            longestSmoothedRun(r.range_angle_rad, column, view.options.window_size).rows == 0;
        for (int row = 0; row < r.labels.rows(); ++row) {
            if (r.labels(row, column) != Label::Roi) continue;
            const std::tuple found(is_unchanged, r.repaired_m(row, column));
            if (!(found < best)) continue;
            chosen = column;
            best = found;
        }
    }
    return chosen;
}

}  // namespace

const base::OutputKind kStagePictures{
    "a folder of pictures", [](const std::filesystem::path& within) {
        constexpr std::array kNames{"overview.png", "1_depth.png",       "2_maxima.png",
                                    "3_merged.png", "4_range_angle.png", "5_smoothed.png",
                                    "6_labels.png", "7_top_view.png"};
        return std::find(kNames.begin(), kNames.end(), within.filename()) != kNames.end();
    }};

void drawStages(const StageView& view, const std::filesystem::path& folder) {
    const SegmentationResult& r = view.result;
    const Options& options = view.options;
    if (r.labels.rows() != view.sensor.rows()) {
        throw std::invalid_argument("drawStages: images of " + std::to_string(r.labels.rows()) +
                                    " rows do not match a sensor with " +
                                    std::to_string(view.sensor.rows()) + " beams");
    }
    const std::vector<RoiBox> boxes = boxRoiComponents(view.scan, r.returns);
    std::vector<float> maxima, obstacles;
    std::vector<std::int32_t> large;
    for (const Maximum& m : r.maxima) {
        maxima.insert(maxima.end(), {static_cast<float>(m.column), static_cast<float>(m.row),
                                     m.birth_m, m.death_m});
    }
    for (const RoiBox& box : boxes) {
        const auto &low = box.extents_m.min(), &high = box.extents_m.max();
        obstacles.insert(obstacles.end(),
                         {box.nearest_m, high.z() - low.z(), low.x(), low.y(), high.x(), high.y()});
    }
    for (const RoiBox& box : boxesToDraw(boxes)) large.push_back(box.component);

    const int column = selectedColumn(view);
    const Run run = longestSmoothedRun(r.range_angle_rad, column, options.window_size);
    SeriesComponents components;
    if (run.rows > 0) {
        components = decomposeSeries(r.range_angle_rad.col(column).segment(run.first_row, run.rows),
                                     options.window_size);
    }
    const std::vector<double> variances(components.eigenvalues.begin(),
                                        components.eigenvalues.end());
    Drawing drawing({{"kind", "stages"},
                     {"folder", folder.string()},
                     {"title", view.title},
                     {"zone_m", options.zone_m},
                     {"window_size", options.window_size},
                     {"kept", options.principal_components},
                     {"column", column},
                     {"first_row", run.first_row},
                     {"elevations_rad", view.sensor.elevations_rad},
                     {"variances", variances},
                     {"large", large}});
    drawing.add("depth_m", r.range_image.depth_m);
    drawing.add("repaired_m", r.repaired_m);
    drawing.add("merged_m", options.raw_angles ? r.repaired_m : r.merged_m);
    drawing.add("angle_rad", r.range_angle_rad);
    drawing.add("smoothed_rad", options.raw_angles ? r.range_angle_rad : r.smoothed_rad);
    drawing.add("labels", r.labels);
    drawing.add("components", r.components);
    drawing.add("pixel_of_return", r.range_image.depth_mapper.data(), {view.scan.size()});
    drawing.add("x_m", view.scan.x_m);
    drawing.add("y_m", view.scan.y_m);
    drawing.add("label", r.returns.label);
    drawing.add("component", r.returns.component);
    drawing.add("maxima", maxima.data(), {r.maxima.size(), 4});
    drawing.add("boxes", obstacles.data(), {boxes.size(), 6});
    drawing.add("elementary", components.elementary.data(),
                {variances.size(), static_cast<std::size_t>(run.rows)});
    drawing.draw();
}

}  // namespace hagen::convert
