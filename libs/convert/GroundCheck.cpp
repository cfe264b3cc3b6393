#include "convert/GroundCheck.h"

#include <hagen/scan/Angle.h>
#include <algorithm>
#include <utility>
#include "base/NumberText.h"

namespace hagen::convert {
namespace {

constexpr std::size_t kTried = 10;  // scans labelled again
// The share of these with ground, for a mount to be proposed; indoors, a wall can look like ground.
constexpr double kMinShare = 1;

/// Mounts of the sensor that are not upright. A camera frame (z forward, y down) is on its side.
const std::pair<const char*, Attitude> kMounts[] = {
    {"sensor.mount_roll_deg=180", {static_cast<float>(radians(180)), 0}},
    {"sensor.mount_roll_deg=90", {static_cast<float>(radians(90)), 0}},
    {"sensor.mount_roll_deg=-90", {static_cast<float>(radians(-90)), 0}},
    {"sensor.mount_pitch_deg=90", {0, static_cast<float>(radians(90))}},
    {"sensor.mount_pitch_deg=-90", {0, static_cast<float>(radians(-90))}}};

/// Whether a share of the returns in the zone is ground.
bool hasGround(const Scan& scan, const LabelledReturns& returns, float zone_m) {
    constexpr double kMinGround = 0.01;
    std::size_t ground = 0, others = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (!(scan.range_m[i] <= zone_m)) continue;
        ++(returns.label[i] == Label::Rou ? ground : others);
    }
    return static_cast<double>(ground) >= kMinGround * static_cast<double>(ground + others);
}

}  // namespace

void GroundCheck::see(const observations::ObservationSegmenter::Output& segmented) {
    if (!segmented.options->ground_surface || segmented.scan->size() == 0) return;
    ++scans_;
    zone_m_ = segmented.options->zone_m;
    if (hasGround(*segmented.scan, segmented.result->returns, zone_m_)) {
        ++with_ground_;
        return;
    }
    if (++tried_ > kTried) return;
    HagenFilter filter(*segmented.sensor, *segmented.options);
    for (const auto& [setting, mount] : kMounts) {
        const SegmentationResult& result = filter.segment(*segmented.scan, mount);
        found_[setting] += hasGround(*segmented.scan, result.returns, zone_m_);
    }
}

std::string GroundCheck::warning() const {
    if (2 * with_ground_ >= scans_) return "";
    const std::size_t tried = std::min(tried_, kTried);
    const auto best =
        std::max_element(found_.begin(), found_.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    std::string text = "no ground was found in " + std::to_string(scans_ - with_ground_) + " of " +
                       base::counted(scans_, "scan") + ": all their returns within " +
                       base::shortestText(zone_m_) + " m count as obstacles. ";
    if (static_cast<double>(best->second) >= kMinShare * static_cast<double>(tried)) {
        return text + "With --set " + best->first + ", " + std::to_string(best->second) + " of " +
               std::to_string(tried) +
               " of them have ground: is the sensor mounted so, or are its axes not x "
               "forward, z up?";
    }
    return text +
           "Is ground in view? Coordinates must be x forward, z up; for a tilted or upside "
           "down sensor, set sensor.mount_roll_deg and mount_pitch_deg, or add poses";
}

}  // namespace hagen::convert
