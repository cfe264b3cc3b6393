#include "RecordedFilter.h"

#include <hagen/filter/SlidingWindow.h>
#include <hagen/scan/Airframe.h>

#include <map>
#include <string>

#include "Filter.h"
#include "captures/Recorded.h"

namespace hagen::python {
namespace {

bool isSameSensor(const SensorModel& a, const SensorModel& b) {
    return a.elevations_rad == b.elevations_rad && a.min_range_m == b.min_range_m &&
           a.max_range_m == b.max_range_m && a.has_rings == b.has_rings;
}

}  // namespace

struct RecordedFilter::State {
    Settings settings;
    std::map<std::string, SlidingWindow> windows;  ///< by sensor label
};

RecordedFilter::RecordedFilter(const Settings& settings)
    : state_(std::make_unique<State>(State{settings, {}})) {}
RecordedFilter::~RecordedFilter() = default;

RecordedFilter::Used RecordedFilter::segment(const PythonScan& scan,
                                             const std::optional<Attitude>& attitude,
                                             Segmented& segmented) {
    const Settings& settings = state_->settings;
    SensorModel sensor = scan.sensor;
    sensor.min_range_m = settings.sensor.min_range_m.value_or(sensor.min_range_m);
    sensor.max_range_m = settings.sensor.max_range_m.value_or(sensor.max_range_m);
    auto& windows = state_->windows;
    auto window = windows.find(scan.sensor_label);
    if (window == windows.end() || !isSameSensor(window->second.filter().sensor(), sensor)) {
        if (window != windows.end()) windows.erase(window);
        SlidingWindow made(filterFor(sensor, settings.optionsFor(nullptr)));
        window = windows.emplace(scan.sensor_label, std::move(made)).first;
    }
    Scan returns = scan.recorded->returns;
    maskAirframe(settings.airframe.parts, returns);
    segmented.result = window->second.segment(
        returns, attitude ? attitude : settings.tiltOnLevelVehicle(), std::nullopt);
    segmented.scan = window->second.labelled();
    const HagenFilter& filter = window->second.filter();
    segmented.sensor = filter.sensor().name;
    segmented.remark = scan.remark;
    return {&filter.sensor(), &filter.options()};
}

}  // namespace hagen::python
