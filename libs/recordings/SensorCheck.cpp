#include "recordings/SensorCheck.h"

#include <hagen/mrpt/ObservationScan.h>
#include "base/NumberText.h"
#include "recordings/Remarks.h"

#include <stdexcept>

namespace hagen::recordings {
namespace {

// The fit of real motion-compensated turns is 76 to 88 % with their own 16 beams, and 31 to 44 %
// with another sensor's.
constexpr float kRemarkBelow = 0.75f;
constexpr float kErrorBelow = 0.5f;
// Real scans of 16 and 64 beams have at least 0.92; 16 beams taken for 64 have 0.29 to 0.37.
constexpr float kFilledBelow = 0.5f;

}  // namespace

std::string SensorCheck::judge(const std::string& title, const Seen& seen) const {
    const BeamFit& fit = seen.best;
    const float share = fit.share();
    if (share >= kRemarkBelow && fit.filled >= kFilledBelow) return "";
    if (share >= kRemarkBelow) {
        return "most pixels of " + seen.sensor + " with its " + std::to_string(seen.rows) +
               " beams are empty: three quarters of the rows have returns in at most " +
               base::percentText(fit.filled) +
               " of their columns. Is it a sensor with fewer beams?";
    }
    std::string text = base::percentText(share) + " of the cloud fits " + seen.sensor +
                       " with its " + std::to_string(seen.rows) +
                       " beams: " + base::percentText(fit.returns_share) +
                       " of the returns lie on them";
    if (fit.beams_shown > 0) {
        text += ", and the cloud shows " + std::to_string(fit.beams_seen) + " of the " +
                std::to_string(fit.beams) + " beams in view";
        const std::size_t others = fit.beams_shown - fit.beams_seen;
        if (others > 0) text += " and " + counted(others, "other beam");
    }
    if (share >= kErrorBelow) return text + ". Is it this sensor?";
    throw std::runtime_error(
        recording_ + ": " + title + ": only " + text +
        ". The cloud is from another sensor, its points are not in the sensor frame, or "
        "its elevations are not in degrees. Specify the correct sensor, or add "
        "'sensor: {model: recovered}' in a later settings file");
}

std::string SensorCheck::see(const RecordedScan& recorded,
                             const observations::ObservationSegmenter::Output& segmented) {
    if (!observations::isCloud(*recorded.observation)) return "";
    if (segmented.recovered || segmented.is_sensor_assumed) return "";
    Seen& seen = seen_[recorded.observation->sensorLabel];
    if (seen.clouds >= kClouds) return "";
    const auto fit = fitBeams(*segmented.scan, *segmented.sensor, segmented.options->columns);
    if (!fit) return "";
    ++seen.clouds;
    seen.sensor = segmented.sensor->name;
    seen.rows = segmented.sensor->rows();
    if (seen.clouds == 1 || fit->share() > seen.best.share()) seen.best = *fit;
    return seen.clouds == kClouds ? judge(titleOf(recorded), seen) : "";
}

std::map<std::string, std::string> SensorCheck::finish() {
    std::map<std::string, std::string> remarks;
    for (const auto& [label, seen] : seen_) {
        if (seen.clouds == 0 || seen.clouds >= kClouds) continue;
        const std::string remark = judge("sensor " + label, seen);
        if (!remark.empty()) remarks[label] = remark;
    }
    return remarks;
}

std::string SensorCheck::textOf(const std::string& sensor_label) const {
    const auto seen = seen_.find(sensor_label);
    if (seen == seen_.end() || seen->second.clouds == 0) return "";
    return base::percentText(seen->second.best.returns_share) + " of the returns lie on them";
}

}  // namespace hagen::recordings
