#include <hagen/settings/CloudSensors.h>
#include "base/NumberText.h"

#include <cmath>

namespace hagen {
namespace {

constexpr int kMinRows = 3;  // minimum number of rows of the filter's image

std::size_t returnsWithRange(const Scan& scan) {
    std::size_t returns = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const float x = scan.x_m[i], y = scan.y_m[i], z = scan.z_m[i];
        returns += std::isfinite(x) && std::isfinite(y) && std::isfinite(z) &&
                   (x != 0 || y != 0 || z != 0);
    }
    return returns;
}

}  // namespace

void CloudSensors::see(const std::string& label, const Scan& scan,
                       const std::vector<std::int32_t>& rings) {
    if (isSettled(label)) return;
    const std::size_t returns = returnsWithRange(scan);
    if (returns < kMinReturnsForBeams) return;
    Seen& seen = seen_[label];
    ++seen.clouds;
    if (returns <= seen.returns) return;
    std::optional<RecoveredBeams> recovered;
    if (!rings.empty()) recovered = ringBeams(scan, rings);
    if (!recovered) {
        recovered = recoverBeams(scan);
        if (recovered) recovered->has_unfit_rings = !rings.empty();
    }
    if (!recovered || recovered->sensor.rows() < kMinRows) return;
    seen.returns = returns;
    seen.beams = std::make_shared<const RecoveredBeams>(std::move(*recovered));
}

bool CloudSensors::isSettled(const std::string& label) const {
    const auto seen = seen_.find(label);
    return seen != seen_.end() && seen->second.clouds >= kClouds;
}

SharedBeams CloudSensors::beamsOf(const std::string& label) const {
    const auto seen = seen_.find(label);
    return seen == seen_.end() ? nullptr : seen->second.beams;
}

std::string textOf(const SharedBeams& beams) {
    if (!beams) {
        return "too few returns or beams to recover the elevations; assuming VLP-16 "
               "(set sensor.model)";
    }
    const SensorModel& sensor = beams->sensor;
    const std::string unfit =
        beams->has_unfit_rings ? "; ring numbers contradict the elevations and are ignored" : "";
    if (!sensor.has_rings) {
        return "no beams found, using " + std::to_string(sensor.rows()) + " virtual rows" + unfit;
    }
    const std::size_t seen = beams->seen_rad.size();
    std::string text = std::to_string(seen) + " beams " +
                       (beams->row_of_ring.empty() ? "recovered" : "by ring number");
    if (sensor.name != kRecoveredName) {
        text += " (" + sensor.name;
        const auto rows = static_cast<std::size_t>(sensor.rows());
        if (seen < rows) text += ", which has " + std::to_string(rows);
        text += ")";
    }
    return text + ", " + base::percentText(beams->share) +
           (beams->row_of_ring.empty() ? " of the returns lie on them"
                                       : " of the returns are closest to their own beam") +
           unfit;
}

}  // namespace hagen
