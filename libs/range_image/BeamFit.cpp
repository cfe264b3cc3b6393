#include <hagen/range_image/Angle.h>
#include <hagen/range_image/BeamFit.h>
#include <hagen/range_image/RecoverBeams.h>
#include <algorithm>
#include <cmath>
#include <vector>

namespace hagen {
namespace {

const float kTolerance_rad = static_cast<float>(radians(kBeamFitTolerance_deg));

bool isOnABeam(float elevation_rad, const SensorModel& sensor) {
    const float beam_rad = sensor.elevations_rad[sensor.nearestRow(elevation_rad)];
    return std::abs(elevation_rad - beam_rad) <= kTolerance_rad;
}

/// How many of the beams shown are beams of the sensor, each of which stands for one at most. Both
/// are ascending.
std::size_t countCommon(const std::vector<float>& shown_rad, const std::vector<float>& beams_rad) {
    std::size_t common = 0, beam = 0;
    for (const float shown : shown_rad) {
        while (beam < beams_rad.size() && beams_rad[beam] < shown - kTolerance_rad) ++beam;
        if (beam == beams_rad.size()) break;
        if (beams_rad[beam] > shown + kTolerance_rad) continue;
        ++common;
        ++beam;
    }
    return common;
}

}  // namespace

float BeamFit::share() const {
    const std::size_t most = std::max(beams, beams_shown);
    if (most == 0) return returns_share;
    return std::min(returns_share, static_cast<float>(beams_seen) / static_cast<float>(most));
}

std::optional<BeamFit> fitBeams(const Scan& scan, const SensorModel& sensor) {
    if (!sensor.has_rings) return std::nullopt;
    const auto shown = recoverBeams(scan);
    if (!shown) return std::nullopt;
    BeamFit fit;
    std::size_t on_beams = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const float x = scan.x_m[i], y = scan.y_m[i], z = scan.z_m[i];
        const float level_m = std::hypot(x, y);
        if (!std::isfinite(level_m + z) || (level_m == 0 && z == 0)) continue;
        ++fit.returns;
        on_beams += isOnABeam(std::atan2(z, level_m), sensor);
    }
    fit.returns_share = static_cast<float>(on_beams) / static_cast<float>(fit.returns);
    if (!shown->sensor.has_rings) return fit;
    const std::vector<float>& shown_rad = shown->seen_rad;
    fit.beams_shown = shown_rad.size();
    fit.beams_seen = countCommon(shown_rad, sensor.elevations_rad);
    fit.beams = static_cast<std::size_t>(
        std::count_if(sensor.elevations_rad.begin(), sensor.elevations_rad.end(), [&](float beam) {
            return beam >= shown_rad.front() - kTolerance_rad &&
                   beam <= shown_rad.back() + kTolerance_rad;
        }));
    return fit;
}

}  // namespace hagen
