#include <hagen/range_image/Angle.h>
#include <hagen/segmentation/CanopyLayer.h>
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

HagenFilter::HagenFilter(SensorModel sensor, Options options)
    : sensor_(std::move(sensor)), options_(options) {
    checkOptions(options_, sensor_.rows());
}

const SegmentationResult& HagenFilter::segment(const Scan& scan,
                                               const std::optional<Attitude>& attitude) {
    const Options& o = options_;
    SegmentationResult& r = result_;
    const Image<float>& depth_m = r.repaired_m;
    const Attitude level = attitude && o.level_by_attitude ? *attitude : Attitude{};

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
    if (attitude && o.level_by_attitude) {
        levelRangeAngles(r.merged_m, sensor_, *attitude, r.range_angle_rad);
    } else {
        rangeAngles(r.merged_m, sensor_, r.range_angle_rad);
    }
    smoothColumns(r.range_angle_rad, o.window_size, o.principal_components, r.smoothed_rad);
    carryAngles(r.smoothed_rad, r.pixel_angle_rad);

    // III-E, labels
    labelRegions(depth_m, r.pixel_angle_rad, static_cast<float>(radians(o.beta_deg)), o.seeds,
                 static_cast<float>(radians(o.seed_gate_deg)), r.labels);

    // beyond the paper: what was found to be ground tells what else is
    if (o.ground_surface) {
        locatePixels(scan, sensor_, r.range_image, depth_m, r.pixels);
        r.ground_from_sensor = fitGroundFrame(r.pixels, level);
        movePixels(r.ground_from_sensor, r.pixels);
        fitGroundSurface(r.pixels, r.labels, r.ground);
        heightsAbove(r.ground, r.pixels, r.height_m);
        toleratedHeights(
            r.pixels, r.height_m,
            {o.ground_tolerance_m, o.ground_tolerance_per_m, o.ground_tolerance_beside_tall},
            r.tolerance_m);
        if (o.canopy_layer) tolerateCanopy(r.pixels, r.height_m, r.tolerance_m);
        labelByHeight(r.height_m, r.tolerance_m, r.labels);
        if (o.grow_feet) growFeet(r.pixels, r.height_m, r.labels);
        if (o.remove_specks) removeSpecks(r.pixels, r.height_m, r.tolerance_m, r.labels);
        judgeFartherReturns(scan, r.range_image, r.ground_from_sensor, r.ground, r.tolerance_m,
                            r.own_label);
    }

    limitToZone(depth_m, o.zone_m, r.labels);
    numberRoiComponents(depth_m, r.labels, o.component_gap_m, r.components);
    extractReturns(scan, sensor_, r.range_image, r.labels, r.components, r.own_label, o.zone_m,
                   r.returns);
    return r;
}

}  // namespace hagen
