#include <hagen/filter/ResultCheck.h>
#include <hagen/scan/Angle.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <optional>
#include <utility>

namespace hagen {
namespace {

constexpr std::size_t kMinReturns = 100;
constexpr std::size_t kTried = 10;     // scans labelled again with other mounts
constexpr std::size_t kDetailed = 10;  // after as many scans, every 10th is checked in detail
constexpr float kFar_m = 200, kNear_m = 0.3f;
constexpr float kMaxSweep_s = 0.5f;  // 5 Hz, and a margin

/// Mounts of the sensor that are not upright, the most likely first. A camera frame (z forward, y
/// down) is on its side.
constexpr std::pair<const char*, Attitude> kMounts[] = {
    {"sensor.mount_roll_deg=180", {static_cast<float>(radians(180)), 0}},
    {"sensor.mount_roll_deg=90", {static_cast<float>(radians(90)), 0}},
    {"sensor.mount_roll_deg=-90", {static_cast<float>(radians(-90)), 0}},
    {"sensor.mount_pitch_deg=90", {0, static_cast<float>(radians(90))}},
    {"sensor.mount_pitch_deg=-90", {0, static_cast<float>(radians(-90))}}};

std::string textOf(const char* format, float number) {
    char text[32];
    return {text, text + std::snprintf(text, sizeof text, format, static_cast<double>(number))};
}

/// Whether a share of the returns in the zone is ground.
bool hasGround(const Scan& scan, const std::vector<Label>& label, float zone_m) {
    constexpr double kMinGround = 0.01;
    std::uint32_t ground = 0, near = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const std::uint32_t is_near = scan.range_m[i] <= zone_m, is_rou = label[i] == Label::Rou;
        near += is_near;
        ground += is_near & is_rou;  // vectorised, because there is no branch
    }
    return ground >= kMinGround * near;
}

float medianOf(std::vector<float>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The range that more than half of the returns have, to 1 mm.
std::optional<float> rangeOfMost(const std::vector<float>& ranges_m) {
    std::vector<float> sorted_m = ranges_m;
    const float median_m = medianOf(sorted_m);
    const auto isSame = [&](float range_m) { return std::abs(range_m - median_m) < 1e-3f; };
    const auto same = std::count_if(ranges_m.begin(), ranges_m.end(), isSame);
    if (2 * static_cast<std::size_t>(same) <= ranges_m.size()) return std::nullopt;
    return median_m;
}

/// Whether the ranges of neighbouring pixels differ as much as those of any two pixels.
bool hasStrangeNeighbours(const Scan& scan, const SensorModel& sensor, int columns) {
    constexpr std::size_t kMinPairs = 50;
    constexpr float kMaxRatio =
        0.6f;  // measured: at most 0.3 for real scans, 0.9 for wrong formats
    const auto rows = static_cast<std::size_t>(sensor.rows()),
               width = static_cast<std::size_t>(columns);
    std::vector<float> image(rows * width, 0);
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const double turned = -static_cast<double>(scan.azimuth_rad[i]) / kTurn_rad;
        const auto column =
            static_cast<std::size_t>((turned - std::floor(turned)) * columns) % width;
        if (scan.range_m[i] > 0 && scan.row[i] < rows)
            image[scan.row[i] * width + column] = scan.range_m[i];
    }
    std::vector<float> beside, anywhere;
    for (std::size_t i = 0; i + 1 < image.size(); ++i) {
        const float other = image[(i * 7919 + width / 3) % image.size()];
        if (image[i] == 0 || image[i + 1] == 0 || other == 0) continue;
        beside.push_back(std::abs(std::log(image[i] / image[i + 1])));
        anywhere.push_back(std::abs(std::log(image[i] / other)));
    }
    if (beside.size() < kMinPairs) return false;
    return medianOf(beside) > kMaxRatio * medianOf(anywhere) && medianOf(anywhere) > 0.05f;
}

/// Whether the times of a turning sensor neither increase nor decrease with the azimuth.
bool haveTimesNoOrder(const Scan& scan) {
    constexpr int kParts = 36;
    std::array<double, kParts> sum_s{}, count{};
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const double turned = -static_cast<double>(scan.azimuth_rad[i]) / kTurn_rad;
        const auto part = static_cast<std::size_t>((turned - std::floor(turned)) * kParts) % kParts;
        sum_s[part] += static_cast<double>(scan.time_s[i]);
        ++count[part];
    }
    int up = 0, down = 0;
    for (std::size_t part = 0; part < kParts; ++part) {
        const std::size_t next = (part + 1) % kParts;
        if (count[part] == 0 || count[next] == 0) continue;
        ++(sum_s[next] / count[next] > sum_s[part] / count[part] ? up : down);
    }
    return 4 * std::min(up, down) > up + down && up + down > kParts / 4;
}

}  // namespace

void ResultCheck::Count::add(bool is_suspicious) {
    ++scans;
    suspicious += is_suspicious;
}

std::string ResultCheck::Count::text() const {
    return std::to_string(suspicious) + " of " + std::to_string(scans) +
           (scans == 1 ? " scan" : " scans");
}

void ResultCheck::add(const Scan& scan, const std::vector<Label>& label, const SensorModel& sensor,
                      const Options& options) {
    if (scan.size() < kMinReturns) return;
    zone_m_ = options.zone_m;
    if (options.ground_surface) {
        const bool has_ground = hasGround(scan, label, zone_m_);
        ground_.add(!has_ground);
        if (tries_mounts_ && !has_ground && ++tried_ <= kTried) tryMounts(scan, sensor, options);
    }
    obstacles_.add(std::find(label.begin(), label.end(), Label::Roi) == label.end());
    if (++seen_ > kDetailed && seen_ % kDetailed != 0) return;

    std::vector<float> ranges_m;
    std::copy_if(scan.range_m.begin(), scan.range_m.end(), std::back_inserter(ranges_m),
                 [](float range_m) { return range_m > 0 && std::isfinite(range_m); });
    if (ranges_m.size() < kMinReturns) return;
    const std::optional<float> one_range_m = rangeOfMost(ranges_m);
    one_range_.add(one_range_m.has_value());
    range_m_ = one_range_m.value_or(range_m_);
    const float median_m = medianOf(ranges_m);
    too_far_.add(median_m > kFar_m);
    too_near_.add(median_m < kNear_m);
    neighbours_.add(hasStrangeNeighbours(scan, sensor, options.columns));
    if (scan.time_s.empty()) return;
    const auto [first, last] = std::minmax_element(scan.time_s.begin(), scan.time_s.end());
    const float span_s = *last - *first;
    if (!(span_s > 0)) return;
    const bool is_long = span_s > kMaxSweep_s;
    times_.add(is_long || (sensor.has_rings && haveTimesNoOrder(scan)));
    if (is_long) time_s_ = span_s;
}

void ResultCheck::tryMounts(const Scan& scan, const SensorModel& sensor, const Options& options) {
    HagenFilter filter(sensor, options);
    for (std::size_t i = 0; i < found_.size(); ++i) {
        const SegmentationResult& result = filter.segment(scan, kMounts[i].second);
        found_[i] += hasGround(scan, result.returns.label, zone_m_);
    }
}

std::string ResultCheck::groundWarning() const {
    // A mount is proposed only if it fits all scans tried; indoors, a wall can look like ground.
    const std::size_t tried = std::min(tried_, kTried);
    const auto best = std::max_element(found_.begin(), found_.end());
    const std::string text = "no ground was found in " + ground_.text() +
                             ": all their returns within " + textOf("%g", zone_m_) +
                             " m count as obstacles. ";
    if (tried > 0 && *best == tried) {
        return text + "With --set " + kMounts[best - found_.begin()].first + ", " +
               std::to_string(tried) + " of " + std::to_string(tried) +
               " of them have ground: is the sensor mounted so, or are its axes not x "
               "forward, z up?";
    }
    return text +
           "Is ground in view? Coordinates must be x forward, z up; for a tilted or upside "
           "down sensor, set sensor.mount_roll_deg and mount_pitch_deg, or add poses";
}

std::vector<std::string> ResultCheck::warnings() const {
    std::vector<std::string> warnings;
    if (ground_.isMost()) warnings.push_back(groundWarning());
    if (obstacles_.isMost()) {
        warnings.push_back("no obstacle was found in " + obstacles_.text() +
                           ". If some are within " + textOf("%g", zone_m_) +
                           " m (zone_m): are the coordinates in metres, relative to the sensor (x "
                           "forward, z up) and not to a map?");
    }
    if (one_range_.isMost()) {
        warnings.push_back(
            "most returns have the same range, " + textOf("%g", range_m_) + " m, in " +
            one_range_.text() +
            ": are they missing returns, or a cover of the sensor? Exclude them with "
            "--set sensor.min_range_m or sensor.max_range_m");
    }
    if (too_far_.isMost()) {
        warnings.push_back("most returns are farther than 200 m in " + too_far_.text() +
                           ": are the coordinates in millimetres instead of metres, or relative to "
                           "a map instead of the sensor?");
    }
    if (too_near_.isMost()) {
        warnings.push_back("most returns are nearer than 0.3 m in " + too_near_.text() +
                           ": are the coordinates in another unit than metres, or is the sensor "
                           "covered?");
    }
    if (neighbours_.isMost()) {
        warnings.push_back(
            "neighbouring returns are not near each other in " + neighbours_.text() +
            ": are the fields of the points read in the wrong order or from the wrong "
            "sensor? See --bin-fields, --model and sensor.elevations_deg");
    }
    if (times_.isMost()) {
        warnings.push_back(
            "the times of the returns contradict a sweep in " + times_.text() +
            (time_s_ > 0 ? ": they span " + textOf("%.2f", time_s_) + " s" : "") +
            ". Are they normalised, or in another unit than the file states? Maps use them to "
            "correct "
            "the motion during a sweep");
    }
    return warnings;
}

}  // namespace hagen
