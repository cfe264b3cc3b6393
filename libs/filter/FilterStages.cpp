#include "filter/FilterStages.h"

#include <hagen/scan/Angle.h>
#include <algorithm>
#include "filter/ground/Clearance.h"
#include "filter/ground/StageRules.h"
#include "filter/paper/RangeAngle.h"
#include "filter/paper/Sharpening.h"
#include "filter/simd/CanopyLayer.h"

namespace hagen {
namespace {

float radiansf(float angle_deg) { return static_cast<float>(radians(angle_deg)); }

/// Stages 3 to 5.
void sharpenDepth(float min_range_m, const Options& o, SegmentationResult& r, FilterWorkspace& w) {
    const Image<float>& depth_m = r.repaired_m;
    proximityOf(depth_m, o.zone_m, r.proximity_m);
    findPersistentMaxima(r.proximity_m, o.persistence_m, r.maxima, w.maxima);
    sharpenMaxima(o.sharpen_proximity ? r.proximity_m : depth_m, r.maxima, o.sharpening_sigma_px,
                  o.sharpening_sigma_m, r.sharpened_m, o.sharpen_by_neighbours);
    if (o.sharpen_proximity) {
        mergeMaxima(depth_m, r.proximity_m, r.sharpened_m, r.maxima, min_range_m, r.merged_m);
    } else {
        mergeDepths(depth_m, r.sharpened_m, r.maxima, r.merged_m);
    }
}

/// Clears the results of skipped stages, because exchangeResult() may have left another filter's.
void clearSkipped(SegmentationResult& r) {
    r.maxima.clear();
    for (auto* image : {&r.proximity_m, &r.sharpened_m, &r.merged_m, &r.smoothed_rad}) {
        image->resize(0, 0);
    }
}

}  // namespace

void labelByAngles(const PixelDirections& directions, float min_range_m,
                   const std::optional<Attitude>& horizon, const Options& o, SegmentationResult& r,
                   FilterWorkspace& w) {
    // III-B: local maxima, sharpened
    if (o.raw_angles) {
        clearSkipped(r);
    } else {
        sharpenDepth(min_range_m, o, r, w);
    }

    // III-C and III-D: range-angle image, smoothed
    rangeAngles(o.raw_angles ? r.repaired_m : r.merged_m, directions, horizon, r.range_angle_rad);
    if (o.gaps_are_level) levelGaps(r.range_angle_rad);
    if (!o.raw_angles) {
        smoothColumns(r.range_angle_rad, o.window_size, o.principal_components, r.smoothed_rad,
                      w.ssa);
    }
    carryAngles(o.raw_angles ? r.range_angle_rad : r.smoothed_rad, r.pixel_angle_rad,
                o.angle_to_beam_above);

    // III-E: labels
    labelRegions(r.repaired_m, r.pixel_angle_rad, radiansf(o.beta_deg), o.seeds,
                 radiansf(o.seed_gate_deg), r.labels, w.labelling);
}

bool usesGround(const Options& o) { return o.ground_surface || o.ground_is_roi_below_m > 0; }

void findGroundPlane(const Scan& scan, const PixelDirections& directions,
                     const std::optional<Attitude>& horizon, const Options& o,
                     const std::vector<std::int32_t>* columns, float max_m, SegmentationResult& r,
                     FilterWorkspace& w) {
    Ground& g = r.ground;
    locatePixels(scan, directions, r.range_image, r.repaired_m, g.pixels);
    g.from_sensor =
        fitGroundFrame(g.pixels, horizon.value_or(Attitude{}), w.ground_frame, columns, max_m);
    movePixels(g.from_sensor, g.pixels);
    g.is_seen = canBeGround(g.from_sensor, horizon, r.labels) &&
                (o.ground_evidence || g.from_sensor.translation().z() > evidence_rules::kLowest_m);
    g.has_surface = g.is_seen && o.ground_surface;
}

void findGroundSurface(const Image<Label>& labels, const Options& o,
                       const std::vector<std::int32_t>* columns, Ground& g, FilterWorkspace& w) {
    findPixelCells(g.pixels, g.cells);
    const Image<Label>* candidates = &labels;
    if (o.ground_evidence) {
        findLevelPixels(g.pixels, g.cells, g.is_level, w.evidence);
        keepLevelRou(labels, g.is_level, w.candidates);
        candidates = &w.candidates;
    }
    fitGroundSurface(g.pixels, *candidates, g.surface, w.ground_surface, columns);
    heightsAbove(g.surface, g.pixels, g.height_m);
}

void findTolerances(const Options& o, const CellArea& area, Ground& g, FilterWorkspace& w) {
    const float above_plane_m = g.from_sensor.translation().z();
    const float above_ground_m = above_plane_m - g.surface.at(0, 0);
    toleratedHeights(
        g.pixels, g.cells, g.tops,
        {o.ground_tolerance_m, o.ground_tolerance_per_m, o.ground_tolerance_beside_tall},
        std::max(above_plane_m, evidence_rules::kLowest_m), g.tolerance_m, w.tolerance, area);
    if (o.canopy_layer) tolerateCanopy(g.cells, g.tops, above_ground_m, g.tolerance_m, area);
    g.has_evidence.clear();
    if (o.ground_evidence) {
        requireEvidence(g.pixels, g.cells, g.height_m, g.is_level, above_ground_m, g.tolerance_m,
                        g.has_evidence);
    }
}

void relabelByGround(const Ground& g, const Options& o, Image<Label>& labels, FilterWorkspace& w) {
    if (g.has_surface) {
        labelByHeight(g.height_m, g.tolerance_m, labels);
        // Extends obstacles down to their feet, and removes specks.
        if (o.grow_feet) growFeet(g.pixels, g.height_m, labels, w.feet);
        if (o.remove_specks) removeSpecks(g.pixels, g.height_m, g.tolerance_m, labels, w.specks);
    }
    if (o.ground_surface && o.ground_evidence && !g.is_seen) {
        labels = (labels == Label::Rou).select(Label::Roi, labels);
    }
}

void judgeClearance(const Scan& scan, const std::optional<Attitude>& horizon, const Options& o,
                    SegmentationResult& r, FilterWorkspace& w) {
    const Clearance clearance{upwards(r.ground, horizon), o.ground_is_roi_below_m};
    alarmLowGround(r.ground, clearance, r.labels);
    judgeFartherReturns(scan, r.range_image, r.ground, clearance, o.zone_m, r.own_labels,
                        w.farther_returns);
}

void numberObstacles(const Scan& scan, const Options& o, SegmentationResult& r,
                     FilterWorkspace& w) {
    numberRoiComponents(r.repaired_m, r.labels, o.component_gap_m, r.components, w.components);
    numberReturns(scan, r.range_image, r.components, r.own_labels, o.component_gap_m, r.returns,
                  w.components);
}

}  // namespace hagen
