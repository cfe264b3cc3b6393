#include <hagen/live/FrameCoverage.h>

namespace hagen::live {

std::optional<double> FrameCoverage::add(double time_s, double measured_s,
                                         std::optional<double> sensor_time_s) {
    const double sensor_s = sensor_time_s.value_or(time_s);
    if (!frames_.empty() &&
        (time_s < frames_.back().time_s || sensor_s < frames_.back().sensor_time_s)) {
        frames_.clear();
    }
    frames_.push_back({time_s, sensor_s, measured_s});
    while (time_s - frames_.front().time_s >= kPeriod_s ||
           sensor_s - frames_.front().sensor_time_s >= kPeriod_s) {
        frames_.pop_front();
    }
    double all_s = 0;
    for (const Frame& frame : frames_) all_s += frame.measured_s;
    if (all_s < kMinMeasured_s) return std::nullopt;
    return frames_.front().time_s;
}

}  // namespace hagen::live
