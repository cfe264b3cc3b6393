#include <hagen/range_image/Angle.h>
#include <hagen/segmentation/CanopyLayer.h>
#include <hagen/segmentation/Clearance.h>
#include <hagen/segmentation/FartherReturns.h>
#include <hagen/segmentation/GapRepair.h>
#include <hagen/segmentation/GroundFrame.h>
#include <hagen/segmentation/HagenFilter.h>
#include <hagen/segmentation/HeightLabels.h>
#include <hagen/segmentation/Labelling.h>
#include <hagen/segmentation/RangeAngle.h>
#include <hagen/segmentation/RoiComponents.h>
#include <hagen/segmentation/Sharpening.h>
#include <hagen/segmentation/SingularSpectrumAnalysis.h>
#include <algorithm>

namespace hagen {

namespace {

float radiansf(float angle_deg) { return static_cast<float>(radians(angle_deg)); }

}  // namespace

HagenFilter::HagenFilter(SensorModel sensor, Options options)
    : sensor_(std::move(sensor)), options_(options) {
    checkOptions(options_, sensor_.rows());
    directions_ = pixelDirections(sensor_, options_.columns);
}

const SegmentationResult& HagenFilter::segment(const Scan& scan,
                                               const std::optional<Attitude>& attitude) {
    const Options& o = options_;
    SegmentationResult& r = result_;
    const Image<float>& depth_m = r.repaired_m;
    const std::optional<Attitude> horizon = o.level_by_attitude ? attitude : std::nullopt;

    // III-A, the depth image
    projectScan(scan, sensor_, o.columns, std::max(o.context_m, o.zone_m), r.range_image);
    repairGaps(r.range_image.depth_m, o.repair_max_step_m, r.repaired_m);

    // III-B, local maxima, sharpened
    proximityOf(depth_m, o.zone_m, r.proximity_m);
    findPersistentMaxima(r.proximity_m, o.persistence_m, r.maxima);
    sharpenMaxima(r.proximity_m, r.maxima, o.sharpening_sigma_px, o.sharpening_sigma_m,
                  r.sharpened_m);
    mergeMaxima(depth_m, r.proximity_m, r.sharpened_m, r.maxima, sensor_.min_range_m, r.merged_m);

    // III-C and III-D, the range-angle image, smoothed
    rangeAngles(r.merged_m, directions_, horizon, r.range_angle_rad);
    smoothColumns(r.range_angle_rad, o.window_size, o.principal_components, r.smoothed_rad);
    carryAngles(r.smoothed_rad, r.pixel_angle_rad);

    // III-E, labels
    labelRegions(depth_m, r.pixel_angle_rad, radiansf(o.beta_deg), o.seeds,
                 radiansf(o.seed_gate_deg), r.labels);
    if (o.ground_surface || o.ground_is_roi_below_m > 0) findGround(scan, horizon);
    if (o.ground_surface && r.ground.is_seen) judgeByGround(scan);
    if (o.ground_is_roi_below_m > 0) {
        const Eigen::Vector3f up = upwards(r.ground, horizon);
        alarmLowGround(r.ground, up, o.ground_is_roi_below_m, r.labels);
        alarmLowGround(scan, r.ground, up, o.ground_is_roi_below_m, r.own_label);
    }
    if (o.context_m > o.zone_m) limitToZone(depth_m, o.zone_m, r.labels);
    numberRoiComponents(depth_m, r.labels, o.component_gap_m, r.components);
    extractReturns(scan, sensor_, r.range_image, r.labels, r.components, r.own_label, o.zone_m,
                   o.component_gap_m, r.returns);
    return r;
}

/// Beyond the paper: the plane that the ground lies about, if there is any in sight.
void HagenFilter::findGround(const Scan& scan, const std::optional<Attitude>& horizon) {
    Ground& g = result_.ground;
    locatePixels(scan, directions_, result_.range_image, result_.repaired_m, g.pixels);
    g.from_sensor = fitGroundFrame(g.pixels, horizon.value_or(Attitude{}));
    movePixels(g.from_sensor, g.pixels);
    g.is_seen = canBeGround(g.from_sensor, horizon, result_.labels);
    result_.own_label.clear();
}

/// Beyond the paper: the ground that was found tells what else is ground.
void HagenFilter::judgeByGround(const Scan& scan) {
    const Options& o = options_;
    SegmentationResult& r = result_;
    Ground& g = r.ground;

    // every pixel against the surface under the ROU
    fitGroundSurface(g.pixels, r.labels, g.surface);
    heightsAbove(g.surface, g.pixels, g.height_m);
    findCellTops(g.pixels, g.height_m, g.tops);
    toleratedHeights(
        g.pixels, g.tops,
        {o.ground_tolerance_m, o.ground_tolerance_per_m, o.ground_tolerance_beside_tall},
        g.tolerance_m);
    if (o.canopy_layer) tolerateCanopy(g.tops, g.height_m, g.tolerance_m);
    labelByHeight(g.height_m, g.tolerance_m, r.labels);

    // obstacles down to their feet, without specks; what is seen past them
    if (o.grow_feet) growFeet(g.pixels, g.height_m, r.labels);
    if (o.remove_specks) removeSpecks(g.pixels, g.height_m, g.tolerance_m, r.labels);
    judgeFartherReturns(scan, r.range_image, g, r.own_label);
}

}  // namespace hagen
