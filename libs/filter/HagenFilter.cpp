#include <hagen/filter/Clearance.h>
#include <hagen/filter/DeadBeams.h>
#include <hagen/filter/GapRepair.h>
#include <hagen/filter/HagenFilter.h>
#include <algorithm>

#include "filter/FilterStages.h"

namespace hagen {

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
    checkLocated(scan, sensor_);
    const auto horizonOf = [&](const std::optional<Attitude>& of) {
        return options_.level_by_attitude ? of : std::nullopt;
    };
    const Posture posture = postureOf(attitude);
    if (posture == Posture::Upright) {
        runStages(scan, horizonOf(attitude), views_.at(posture));
        return result_;
    }

    // The same, in a frame in which the rows of the image rise.
    auto view = views_.find(posture);
    if (view == views_.end()) view = views_.emplace(posture, viewIn(posture)).first;
    turnScan(scan, posture, attitude, view->second.sensor, work_.turned);
    runStages(work_.turned, horizonOf(attitudeIn(posture, attitude)), view->second);
    Eigen::Isometry3f& from_sensor = result_.ground.from_sensor;
    from_sensor = from_sensor * Eigen::Isometry3f(imageFromSensor(posture, attitude));
    return result_;
}

void HagenFilter::runStages(const Scan& scan, const std::optional<Attitude>& horizon,
                            const View& view) {
    const Options& o = options_;
    SegmentationResult& r = result_;
    FilterWorkspace& w = work_;
    r.own_labels.label.clear();  // of another filter's scan, perhaps (exchangeResult())
    r.own_labels.returns.clear();
    r.ground.has_surface = r.ground.is_seen = false;

    // III-A: depth image
    projectScan(scan, view.sensor, o.columns, std::max(o.context_m, o.zone_m), r.range_image,
                w.projection);
    repairGaps(r.range_image.depth_m, o.repair_max_step_m, r.repaired_m);
    if (o.bridge_dead_beams)
        bridgeDeadBeams(r.range_image.depth_m, view.directions, r.repaired_m, w.dead_beams);

    labelByAngles(r.repaired_m, view.directions, view.sensor.min_range_m, horizon, o, r, w);
    if (o.ground_surface || o.ground_is_roi_below_m > 0) judgeByGround(scan, horizon, view);
    if (o.context_m > o.zone_m) limitToZone(r.repaired_m, o.zone_m, r.labels);
    numberRoiComponents(r.repaired_m, r.labels, o.component_gap_m, r.components, w.components);
    extractReturns(scan, {r.range_image, r.labels, r.components}, r.own_labels,
                   {o.zone_m, o.component_gap_m}, r.returns, w.extraction);
}

/// Beyond the paper: uses the detected ground to find what else is ground, and what is too close.
void HagenFilter::judgeByGround(const Scan& scan, const std::optional<Attitude>& horizon,
                                const View& view) {
    const Options& o = options_;
    SegmentationResult& r = result_;
    Ground& g = r.ground;
    findGround(scan, view.directions, r, horizon, o, nullptr, g, work_);
    if (g.has_surface) relabelByHeight(g.pixels, g.height_m, g.tolerance_m, o, r.labels, work_);
    if (o.ground_surface && o.ground_evidence && !g.is_seen) doubtAll(r.labels);

    // ground that is too close; returns behind the closest one of their pixel
    const Clearance clearance{upwards(g, horizon), o.ground_is_roi_below_m};
    alarmLowGround(g, clearance, r.labels);
    judgeFartherReturns(scan, r.range_image, g, clearance, o.zone_m, r.own_labels,
                        work_.farther_returns);
}

}  // namespace hagen
