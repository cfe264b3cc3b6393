#include <hagen/filter/HagenFilter.h>
#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>
#include "filter/image/DeadBeams.h"
#include "filter/image/GapRepair.h"
#include "filter/image/Posture.h"

#include "filter/FilterStages.h"

namespace hagen {
namespace {

/// The image's rows and columns for one sensor posture.
struct View {
    SensorModel sensor;
    PixelDirections directions;
};

}  // namespace

struct HagenFilter::State {
    SensorModel sensor;
    Options options;
    std::map<Posture, View> views;  ///< created on demand
    SegmentationResult result;
    FilterWorkspace work;

    const View& viewIn(Posture posture);
    void runStages(const Scan& window, const Scan& newest, const std::optional<Attitude>& horizon,
                   const View& view, const Options& o);
    void judgeByGround(const Scan& window, const Scan& labelled,
                       const std::optional<Attitude>& horizon, const View& view, const Options& o);
};

const View& HagenFilter::State::viewIn(Posture posture) {
    const auto known = views.find(posture);
    if (known != views.end()) return known->second;
    const SensorModel turned = sensorIn(posture, sensor);
    return views[posture] = {turned, pixelDirections(turned, options.columns)};
}

HagenFilter::HagenFilter(SensorModel sensor, Options options) {
    checkOptions(options, sensor.rows());
    state_ = std::make_unique<State>(State{std::move(sensor), options, {}, {}, {}});
    state_->viewIn(Posture::Upright);
}

HagenFilter::HagenFilter(const HagenFilter& other)
    : state_(std::make_unique<State>(*other.state_)) {}
HagenFilter::HagenFilter(HagenFilter&&) noexcept = default;
HagenFilter& HagenFilter::operator=(HagenFilter other) noexcept {
    std::swap(state_, other.state_);
    return *this;
}
HagenFilter::~HagenFilter() = default;

void HagenFilter::exchangeResult(SegmentationResult& result) { std::swap(state_->result, result); }
const SensorModel& HagenFilter::sensor() const { return state_->sensor; }
const Options& HagenFilter::options() const { return state_->options; }

const SegmentationResult& HagenFilter::segment(const Scan& scan,
                                               const std::optional<Attitude>& attitude) {
    return segment(scan, attitude, scan);
}

const SegmentationResult& HagenFilter::segment(const Scan& window,
                                               const std::optional<Attitude>& attitude,
                                               const Scan& newest) {
    State& s = *state_;
    if (newest.size() > window.size())
        throw std::invalid_argument("the newest scan is larger than its window");
    checkLocated(window, s.sensor);
    const auto horizonOf = [&](const std::optional<Attitude>& of) {
        return s.options.level_by_attitude ? of : std::nullopt;
    };
    const Posture posture = postureOf(attitude, s.sensor);
    const View& view = s.viewIn(posture);
    if (posture == Posture::Upright) {
        s.runStages(window, newest, horizonOf(attitude), view, s.options);
        return s.result;
    }

    // The same scan in a frame whose image rows are in ascending elevation.
    turnScan(window, posture, attitude, view.sensor, s.work.turned);
    const bool is_window = newest.size() < window.size();
    if (is_window) turnScan(newest, posture, attitude, view.sensor, s.work.turned_newest);
    Options options = s.options;
    // Below the sensor, level rows are so close that noise cuts the ground's region into pieces.
    if (posture == Posture::OnItsSide && !s.sensor.has_rings && options.ground_surface &&
        options.ground_evidence && options.seeds == Seeds::Lowest) {
        options.seeds = Seeds::Every;
    }
    s.runStages(s.work.turned, is_window ? s.work.turned_newest : s.work.turned,
                horizonOf(attitudeIn(posture, attitude)), view, options);
    Eigen::Isometry3f& from_sensor = s.result.ground.from_sensor;
    from_sensor = from_sensor * Eigen::Isometry3f(imageFromSensor(posture, attitude));
    return s.result;
}

void HagenFilter::State::runStages(const Scan& window, const Scan& newest,
                                   const std::optional<Attitude>& horizon, const View& view,
                                   const Options& o) {
    SegmentationResult& r = result;
    r.own_labels.label.clear();  // exchangeResult() may have left another filter's labels
    r.own_labels.returns.clear();
    r.ground.has_surface = r.ground.is_seen = false;

    // III-A: depth image
    projectScan(window, view.sensor, o.columns, std::max(o.context_m, o.zone_m), r.range_image,
                work.projection);
    if (o.window_fills_gaps && newest.size() < window.size())
        preferFirst(window, newest.size(), r.range_image);
    repairGaps(r.range_image.depth_m, o.repair_max_step_m, r.repaired_m);
    if (o.bridge_dead_beams)
        bridgeDeadBeams(r.range_image.depth_m, view.directions, r.repaired_m, work.dead_beams);

    labelByAngles(view.directions, view.sensor.min_range_m, horizon, o, r, work);
    const Scan& labelled = o.label_window ? window : newest;
    if (usesGround(o)) judgeByGround(window, labelled, horizon, view, o);
    if (o.context_m > o.zone_m) limitToZone(r.repaired_m, o.zone_m, r.labels);
    extractReturns(labelled, r.range_image, r.labels, r.own_labels, o.zone_m, r.returns,
                   work.extraction);
    if (o.number_obstacles) {
        numberObstacles(labelled, o, r, work);
    } else {  // exchangeResult() may have left another filter's numbers
        r.components.resize(0, 0);
        r.returns.component.clear();
    }
}

void HagenFilter::State::judgeByGround(const Scan& window, const Scan& labelled,
                                       const std::optional<Attitude>& horizon, const View& view,
                                       const Options& o) {
    Ground& g = result.ground;
    // Without rings, part of the view may be high above the ground and show crowns only.
    const bool is_partial = !view.sensor.has_rings && horizon;
    findGroundPlane(window, view.directions, horizon, o, nullptr, is_partial ? 0 : kNoLimit_m,
                    result, work);
    if (g.has_surface) {
        findGroundSurface(result.labels, o, nullptr, g, work);
        findCellTops(g.cells, g.height_m, g.tops);
        findTolerances(o, {}, g, work);
    }
    relabelByGround(g, o, result.labels, work);
    judgeClearance(labelled, horizon, o, result, work);
}

}  // namespace hagen
