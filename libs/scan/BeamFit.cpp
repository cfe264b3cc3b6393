#include "scan/BeamFit.h"
#include <hagen/scan/Angle.h>
#include <hagen/scan/RangeImage.h>
#include <hagen/scan/RecoverBeams.h>
#include <algorithm>
#include <cmath>

namespace hagen {
namespace {

const float kTolerance_rad = static_cast<float>(radians(kBeamFitTolerance_deg));

/// The third quartile, over the rows, of the share of pixels with a return. Pixel index:
/// row * columns + column.
float filledOf(const std::vector<bool>& has_return, std::size_t rows, std::size_t columns) {
    std::vector<std::ptrdiff_t> filled(rows);
    for (std::size_t row = 0; row < rows; ++row) {
        const auto first = has_return.begin() + static_cast<std::ptrdiff_t>(row * columns);
        filled[row] = std::count(first, first + static_cast<std::ptrdiff_t>(columns), true);
    }
    std::sort(filled.begin(), filled.end());
    return static_cast<float>(filled[3 * (rows - 1) / 4]) / static_cast<float>(columns);
}

/// Number of the cloud's beams that match a sensor beam, one to one. Both lists are ascending.
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
    const std::size_t max = std::max(beams, beams_shown);
    if (max == 0) return returns_share;
    return std::min(returns_share, static_cast<float>(beams_seen) / static_cast<float>(max));
}

std::optional<BeamFit> fitBeams(const Scan& scan, const SensorModel& sensor, int columns) {
    if (!sensor.has_rings) return std::nullopt;
    const auto shown = recoverBeams(scan);
    if (!shown) return std::nullopt;
    BeamFit fit;
    std::size_t on_beams = 0;
    const auto rows = static_cast<std::size_t>(sensor.rows());
    const auto width = static_cast<std::size_t>(columns);
    std::vector<bool> has_return(rows * width, false);
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const float x = scan.x_m[i], y = scan.y_m[i], z = scan.z_m[i];
        const float level_m = std::hypot(x, y);
        if (!std::isfinite(level_m + z) || (level_m == 0 && z == 0)) continue;
        ++fit.returns;
        const float elevation_rad = std::atan2(z, level_m);
        const auto row = static_cast<std::size_t>(sensor.nearestRow(elevation_rad));
        on_beams += std::abs(elevation_rad - sensor.elevations_rad[row]) <= kTolerance_rad;
        const auto column = static_cast<std::size_t>(nearestColumn(std::atan2(y, x), columns));
        has_return[row * width + column] = true;
    }
    fit.filled = filledOf(has_return, rows, width);
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
