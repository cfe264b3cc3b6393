#include "filter/FilterStages.h"

#include <hagen/filter/CanopyLayer.h>
#include <hagen/filter/RangeAngle.h>
#include <hagen/filter/Sharpening.h>
#include <hagen/scan/Angle.h>
#include <algorithm>

namespace hagen {
namespace {

float radiansf(float angle_deg) { return static_cast<float>(radians(angle_deg)); }

/// The cells of the judged pixels in the zone, and those around that their tolerance depends on.
CellArea areaOf(const Ground& ground, const JudgedPart& part, const Options& options) {
    constexpr float kBeyond_m = 1;  // of the zone: neighbours of pixels at its edge
    constexpr int kSides = 1;       // beside a cell, what is tall matters
    const float most_m = options.zone_m + kBeyond_m;
    const Eigen::Index rows = ground.cells.cell.rows();
    CellArea area{CellArea::kSide, 0, CellArea::kSide, 0};
    for (Eigen::Index k = part.first * rows; k < (part.first + part.count) * rows; ++k) {
        const float x_m = ground.pixels.x_m.data()[k], y_m = ground.pixels.y_m.data()[k];
        if (!(x_m * x_m + y_m * y_m < most_m * most_m)) continue;  // or empty
        const int cell = ground.cells.cell.data()[k];
        const int row = cell % CellArea::kSide, column = cell / CellArea::kSide;
        area.first_row = std::min(area.first_row, row);
        area.end_row = std::max(area.end_row, row + 1);
        area.first_column = std::min(area.first_column, column);
        area.end_column = std::max(area.end_column, column + 1);
    }
    if (area.end_row == 0) return {0, 0, 0, 0};
    return area.grownBy(options.canopy_layer ? kCanopyReach : kSides);
}

/// The surface under the pixels that are labelled ROU, heights above it, tolerances.
void findSurface(const Image<Label>& labels, const Options& o, const JudgedPart* part, Ground& g,
                 FilterWorkspace& w) {
    findPixelCells(g.pixels, g.cells);
    const Image<Label>* candidates = &labels;
    if (o.ground_evidence) {
        findLevelPixels(g.pixels, g.cells, g.is_level, w.evidence);
        keepLevelRou(labels, g.is_level, w.candidates);
        candidates = &w.candidates;
    }
    fitGroundSurface(g.pixels, *candidates, g.surface, w.ground_surface,
                     part != nullptr ? &part->of_surface : nullptr);
    heightsAbove(g.surface, g.pixels, g.height_m);
    const CellArea area = part != nullptr ? areaOf(g, *part, o) : CellArea();
    findCellTops(g.cells, g.height_m, g.tops, area);
    if (part != nullptr) raiseHighest(g.cells, part->known_m, g.tops);
    toleratedHeights(
        g.pixels, g.cells, g.tops,
        {o.ground_tolerance_m, o.ground_tolerance_per_m, o.ground_tolerance_beside_tall},
        g.from_sensor.translation().z(), g.tolerance_m, w.tolerance, area);
    if (o.canopy_layer) tolerateCanopy(g.cells, g.tops, g.tolerance_m, area);
    g.has_evidence.clear();
    if (o.ground_evidence) {
        requireEvidence(g.pixels, g.cells, g.height_m, g.is_level, g.tolerance_m, g.has_evidence,
                        w.evidence);
    }
}

}  // namespace

void labelByAngles(const Image<float>& depth_m, const PixelDirections& directions,
                   float min_range_m, const std::optional<Attitude>& horizon, const Options& o,
                   SegmentationResult& r, FilterWorkspace& w) {
    // III-B: local maxima, sharpened
    proximityOf(depth_m, o.zone_m, r.proximity_m);
    findPersistentMaxima(r.proximity_m, o.persistence_m, r.maxima, w.maxima);
    sharpenMaxima(o.sharpen_proximity ? r.proximity_m : depth_m, r.maxima, o.sharpening_sigma_px,
                  o.sharpening_sigma_m, r.sharpened_m, o.sharpen_by_neighbours);
    if (o.sharpen_proximity) {
        mergeMaxima(depth_m, r.proximity_m, r.sharpened_m, r.maxima, min_range_m, r.merged_m);
    } else {
        mergeDepths(depth_m, r.sharpened_m, r.maxima, r.merged_m);
    }

    // III-C and III-D: range-angle image, smoothed
    rangeAngles(r.merged_m, directions, horizon, r.range_angle_rad);
    if (o.gaps_are_level) levelGaps(r.range_angle_rad);
    smoothColumns(r.range_angle_rad, o.window_size, o.principal_components, r.smoothed_rad, w.ssa);
    carryAngles(r.smoothed_rad, r.pixel_angle_rad, o.angle_to_beam_above);

    // III-E: labels
    labelRegions(depth_m, r.pixel_angle_rad, radiansf(o.beta_deg), o.seeds,
                 radiansf(o.seed_gate_deg), r.labels, w.labelling);
}

void findGround(const Scan& scan, const PixelDirections& directions,
                const SegmentationResult& of_scan, const std::optional<Attitude>& horizon,
                const Options& o, const JudgedPart* part, Ground& g, FilterWorkspace& w) {
    const Image<Label>& labels = of_scan.labels;
    locatePixels(scan, directions, of_scan.range_image, of_scan.repaired_m, g.pixels);
    g.from_sensor = fitGroundFrame(g.pixels, horizon.value_or(Attitude{}), w.ground_frame,
                                   part != nullptr ? &part->of_plane : nullptr);
    movePixels(g.from_sensor, g.pixels);
    g.is_seen = canBeGround(g.from_sensor, horizon, labels);
    g.has_surface = g.is_seen && o.ground_surface;
    if (g.has_surface) findSurface(labels, o, part, g, w);
}

void relabelByHeight(const PixelPoints& pixels, const Image<float>& height_m,
                     const Image<float>& tolerance_m, const Options& o, Image<Label>& labels,
                     FilterWorkspace& w) {
    labelByHeight(height_m, tolerance_m, labels);
    // Obstacles reach down to their feet; specks are removed.
    if (o.grow_feet) growFeet(pixels, height_m, labels, w.feet);
    if (o.remove_specks) removeSpecks(pixels, height_m, tolerance_m, labels, w.specks);
}

void doubtAll(Image<Label>& labels) { labels = (labels == Label::Rou).select(Label::Roi, labels); }

}  // namespace hagen
