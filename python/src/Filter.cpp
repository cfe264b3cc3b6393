#include "Filter.h"

#include <hagen/scan/Airframe.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hagen::python {
namespace {

constexpr std::size_t kMaxIdle = 4;
constexpr const char* kLabel = "points";

bool isLevel(const Attitude& attitude) { return attitude.roll_rad == 0 && attitude.pitch_rad == 0; }

Settings withNumbers(Settings settings) {
    settings.options.number_obstacles = true;
    return settings;
}

}  // namespace

std::vector<float> heightsOf(const Segmented& segmented) {
    const Scan& scan = segmented.scan;
    const Ground& ground = segmented.result.ground;
    std::vector<float> height_m(scan.size(), std::numeric_limits<float>::quiet_NaN());
    if (!ground.has_surface) return height_m;
    std::vector<float> x_m, y_m, z_m;
    std::vector<std::size_t> returns;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (std::isnan(scan.range_m[i])) continue;
        const Eigen::Vector3f point_m =
            ground.from_sensor * Eigen::Vector3f(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
        x_m.push_back(point_m.x());
        y_m.push_back(point_m.y());
        z_m.push_back(point_m.z());
        returns.push_back(i);
    }
    std::vector<float> of_returns(returns.size());
    heightsAbove(ground.surface, returns.size(), x_m.data(), y_m.data(), z_m.data(),
                 of_returns.data());
    for (std::size_t k = 0; k < returns.size(); ++k) height_m[returns[k]] = of_returns[k];
    return height_m;
}

Filter::Filter(const Settings& settings) : settings_(withNumbers(settings)), recorded_(settings_) {
    if (settings_.sensor.model) {
        idle_.emplace_back(filterFor(settings_.sensorModel(), settings_.options));
    }
}

SensorModel Filter::sensor() const {
    const std::lock_guard lock(mutex_);
    return settings_.sensorModel(beams_.get());
}

std::shared_ptr<Segmented> Filter::newResult() {
    std::unique_ptr<Segmented> made;
    {
        const std::lock_guard lock(pool_->mutex);
        if (!pool_->idle.empty()) {
            made = std::move(pool_->idle.back());
            pool_->idle.pop_back();
        }
    }
    if (!made) made = std::make_unique<Segmented>();
    made->remark.clear();
    // Filters with other settings may not overwrite these values of an earlier scan.
    made->result.ground.is_seen = made->result.ground.has_surface = false;
    made->result.own_labels.label.clear();
    made->result.own_labels.returns.clear();
    // The deleter shares the pool, which thus outlives the filter while results are in use.
    return {made.release(), [pool = pool_](Segmented* dropped) {
                std::unique_ptr<Segmented> owned(dropped);
                const std::lock_guard lock(pool->mutex);
                if (pool->idle.size() < kMaxIdle) pool->idle.push_back(std::move(owned));
            }};
}

SlidingWindow Filter::leaseFilter(const Scan& scan, int& generation) {
    const std::lock_guard lock(mutex_);
    if (!settings_.sensor.model && !sensors_.isSettled(kLabel)) {
        sensors_.see(kLabel, scan);
        const SharedBeams beams = sensors_.beamsOf(kLabel);
        if (beams != beams_) {
            beams_ = beams;
            idle_.clear();
            ++generation_;
        }
    }
    generation = generation_;
    if (!idle_.empty()) {
        SlidingWindow filter = std::move(idle_.back());
        idle_.pop_back();
        return filter;
    }
    return SlidingWindow(
        filterFor(settings_.sensorModel(beams_.get()), settings_.optionsFor(beams_.get())));
}

void Filter::giveBack(SlidingWindow&& filter, int generation) {
    const std::lock_guard lock(mutex_);
    if (generation == generation_ && idle_.size() < kMaxIdle) idle_.push_back(std::move(filter));
}

std::shared_ptr<Segmented> Filter::segment(
    const PointsView& points, const std::optional<Attitude>& attitude,
    const std::optional<Eigen::Isometry3d>& map_from_sensor) {
    const std::shared_ptr<Segmented> segmented = newResult();
    copyPoints(points, segmented->scan);
    int generation = 0;
    SlidingWindow window = leaseFilter(segmented->scan, generation);
    HagenFilter& filter = window.filter();
    locateBeams(filter.sensor(), segmented->scan);
    maskAirframe(settings_.airframe.parts, segmented->scan);
    const std::optional<Attitude> otherwise =
        isLevel(settings_.mount) ? std::nullopt : std::optional(settings_.mount);
    // Exchanged before segmenting, too, so that the filter reuses memory.
    filter.exchangeResult(segmented->result);
    window.segment(segmented->scan, attitude ? attitude : otherwise, map_from_sensor);
    filter.exchangeResult(segmented->result);
    if (filter.options().label_window) segmented->scan = window.labelled();
    segmented->sensor = filter.sensor().name;
    check(*segmented, filter.sensor(), filter.options());
    giveBack(std::move(window), generation);
    return segmented;
}

std::shared_ptr<Segmented> Filter::segment(const PythonScan& scan,
                                           const std::optional<Attitude>& attitude) {
    const std::lock_guard lock(segmenting_recorded_);
    const std::shared_ptr<Segmented> segmented = newResult();
    const RecordedFilter::Used used = recorded_.segment(scan, attitude, *segmented);
    check(*segmented, *used.sensor, *used.options);
    return segmented;
}

void Filter::check(const Segmented& segmented, const SensorModel& sensor, const Options& options) {
    const std::lock_guard lock(mutex_);
    check_.add(segmented.scan, segmented.result.returns.label, sensor, options);
    ++scans_;
}

std::vector<std::string> Filter::newWarnings() {
    const std::lock_guard lock(mutex_);
    if (scans_ != 1 && scans_ != 10 && scans_ % 100 != 0) return {};
    std::vector<std::string> warnings = check_.warnings();
    const auto isKnown = [this](const std::string& warning) {
        constexpr std::size_t kKind = 20;  // characters before the number of scans
        return !warned_.insert(warning.substr(0, kKind)).second;
    };
    warnings.erase(std::remove_if(warnings.begin(), warnings.end(), isKnown), warnings.end());
    return warnings;
}

}  // namespace hagen::python
