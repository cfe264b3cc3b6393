#include <hagen/range_image/Angle.h>
#include <hagen/segmentation/CanopyLayer.h>
#include <hagen/segmentation/Clearance.h>
#include <hagen/segmentation/DeadBeams.h>
#include <hagen/segmentation/GapRepair.h>
#include <hagen/segmentation/HagenFilter.h>
#include <hagen/segmentation/RangeAngle.h>
#include <hagen/segmentation/Sharpening.h>
#include <algorithm>

namespace hagen {

namespace {

/// Without ground in sight, nothing is ROU.
void doubtAll(Image<Label>& labels) { labels = (labels == Label::Rou).select(Label::Roi, labels); }

float radiansf(float angle_deg) { return static_cast<float>(radians(angle_deg)); }

}  // namespace

HagenFilter::HagenFilter(SensorModel sensor, Options options)
    : sensor_(std::move(sensor)), options_(options) {
    checkOptions(options_, sensor_.rows());
    views_[Posture::Upright] = viewIn(Posture::Upright);
}

HagenFilter::View HagenFilter::viewIn(Posture posture) const {
    View view{sensorIn(posture, sensor_), {}};
    view.directions = pixelDirections(view.sensor, options_.columns);
    return view;
}

const SegmentationResult& HagenFilter::segment(const Scan& scan,
                                               const std::optional<Attitude>& attitude) {
    return segment(scan, attitude, nullptr);
}

const SegmentationResult& HagenFilter::segment(const Scan& scan,
                                               const std::optional<Attitude>& attitude,
                                               const ColumnMap& columns) {
    return segment(scan, attitude, &columns);
}

const SegmentationResult& HagenFilter::segment(const Scan& scan,
                                               const std::optional<Attitude>& attitude,
                                               const ColumnMap* columns) {
    const std::optional<Attitude> horizon = options_.level_by_attitude ? attitude : std::nullopt;
    const Posture posture = postureOf(horizon);
    if (posture == Posture::Upright) {
        runStages(scan, horizon, views_.at(posture), columns);
        return result_;
    }

    // The same, in a frame in which the rows of the image rise.
    checkLocated(scan, sensor_);
    auto view = views_.find(posture);
    if (view == views_.end()) view = views_.emplace(posture, viewIn(posture)).first;
    turnScan(scan, posture, horizon, view->second.sensor, work_.turned);
    runStages(work_.turned, attitudeIn(posture, horizon), view->second, nullptr);
    Eigen::Isometry3f& from_sensor = result_.ground.from_sensor;
    from_sensor = from_sensor * Eigen::Isometry3f(imageFromSensor(posture, horizon));
    return result_;
}

void HagenFilter::runStages(const Scan& scan, const std::optional<Attitude>& horizon,
                            const View& view, const ColumnMap* columns) {
    const Options& o = options_;
    SegmentationResult& r = result_;
    FilterWorkspace& w = work_;
    const Image<float>& depth_m = r.repaired_m;
    if (columns != nullptr) mapDirections(view.directions, *columns, w.directions);
    const PixelDirections& directions = columns != nullptr ? w.directions : view.directions;

    // III-A: depth image
    const float most_m = std::max(o.context_m, o.zone_m);
    if (columns != nullptr) {
        projectScan(scan, view.sensor, *columns, most_m, r.range_image, w.projection);
    } else {
        projectScan(scan, view.sensor, o.columns, most_m, r.range_image, w.projection);
    }
    repairGaps(r.range_image.depth_m, o.repair_max_step_m, r.repaired_m);
    if (o.bridge_dead_beams)
        bridgeDeadBeams(r.range_image.depth_m, directions, r.repaired_m, w.dead_beams);

    // III-B: local maxima, sharpened
    proximityOf(depth_m, o.zone_m, r.proximity_m);
    findPersistentMaxima(r.proximity_m, o.persistence_m, r.maxima, w.maxima);
    sharpenMaxima(o.sharpen_proximity ? r.proximity_m : depth_m, r.maxima, o.sharpening_sigma_px,
                  o.sharpening_sigma_m, r.sharpened_m, o.sharpen_by_neighbours);
    if (o.sharpen_proximity) {
        mergeMaxima(depth_m, r.proximity_m, r.sharpened_m, r.maxima, view.sensor.min_range_m,
                    r.merged_m);
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
    if (o.ground_surface || o.ground_is_roi_below_m > 0)
        judgeByGround(scan, horizon, directions, columns != nullptr ? &columns->even : nullptr);
    if (o.context_m > o.zone_m) limitToZone(depth_m, o.zone_m, r.labels);
    numberRoiComponents(depth_m, r.labels, o.component_gap_m, r.components, w.components);
    extractReturns(scan, {r.range_image, r.labels, r.components}, r.own_labels,
                   {o.zone_m, o.component_gap_m}, r.returns, w.extraction);
}

/// Beyond the paper: uses the detected ground to find what else is ground, and what is too close.
void HagenFilter::judgeByGround(const Scan& scan, const std::optional<Attitude>& horizon,
                                const PixelDirections& directions,
                                const std::vector<std::int32_t>* even_columns) {
    SegmentationResult& r = result_;
    Ground& g = r.ground;

    // ground plane, if visible
    locatePixels(scan, directions, r.range_image, r.repaired_m, g.pixels);
    g.from_sensor =
        fitGroundFrame(g.pixels, horizon.value_or(Attitude{}), work_.ground_frame, even_columns);
    movePixels(g.from_sensor, g.pixels);
    g.is_seen = canBeGround(g.from_sensor, horizon, r.labels);
    g.has_surface = g.is_seen && options_.ground_surface;
    if (g.has_surface) judgeByHeight(even_columns);
    if (options_.ground_surface && options_.ground_evidence && !g.is_seen) doubtAll(r.labels);

    // ground that is too close; returns behind the closest one of their pixel
    const Clearance clearance{upwards(g, horizon), options_.ground_is_roi_below_m};
    alarmLowGround(g, clearance, r.labels);
    judgeFartherReturns(scan, r.range_image, g, clearance, options_.zone_m, r.own_labels,
                        work_.farther_returns);
}

/// Beyond the paper: labels every pixel by its height above the surface under the ROU.
void HagenFilter::judgeByHeight(const std::vector<std::int32_t>* even_columns) {
    const Options& o = options_;
    Image<Label>& labels = result_.labels;
    Ground& g = result_.ground;
    FilterWorkspace& w = work_;

    findPixelCells(g.pixels, g.cells);
    const Image<Label>* candidates = &labels;
    if (o.ground_evidence) {
        findLevelPixels(g.pixels, g.cells, g.is_level, w.evidence);
        keepLevelRou(labels, g.is_level, w.candidates);
        candidates = &w.candidates;
    }
    fitGroundSurface(g.pixels, *candidates, g.surface, w.ground_surface, even_columns);
    heightsAbove(g.surface, g.pixels, g.height_m);
    findCellTops(g.cells, g.height_m, g.tops);
    toleratedHeights(
        g.pixels, g.cells, g.tops,
        {o.ground_tolerance_m, o.ground_tolerance_per_m, o.ground_tolerance_beside_tall},
        g.from_sensor.translation().z(), g.tolerance_m, w.tolerance);
    if (o.canopy_layer) tolerateCanopy(g.cells, g.tops, g.tolerance_m);
    if (o.ground_evidence) {
        requireEvidence(g.pixels, g.cells, g.height_m, g.is_level, g.tolerance_m, w.evidence);
    }
    labelByHeight(g.height_m, g.tolerance_m, labels);

    // extend obstacles down to their feet, remove specks
    if (o.grow_feet) growFeet(g.pixels, g.height_m, labels, w.feet);
    if (o.remove_specks) removeSpecks(g.pixels, g.height_m, g.tolerance_m, labels, w.specks);
}

}  // namespace hagen
