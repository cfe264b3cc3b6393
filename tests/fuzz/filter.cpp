// The filter with arbitrary scans, sensors, attitudes and options, on different instruction sets.
#include <hagen/filter/HagenFilter.h>
#include "scan/InstructionSets.h"

#include <cmath>
#include <optional>

#include "fuzz/AnyFilter.h"
#include "fuzz/Target.h"

namespace hagen::fuzz {
namespace {

struct Labels {
    std::vector<std::uint8_t> row;
    std::vector<Label> label;
    std::vector<std::int32_t> component;
};

/// The labels of a scan, or no value if the filter rejects the sensor, the options or the scan.
std::optional<Labels> labelsOf(Scan scan, const SensorModel& sensor, const Options& options,
                               const std::optional<Attitude>& attitude) {
    try {
        locateBeams(sensor, scan);
        HagenFilter filter(sensor, options);
        const LabelledReturns& returns = filter.segment(scan, attitude).returns;
        require(returns.label.size() == scan.size(), "a return has no label");
        require(
            returns.roi.size() + returns.rou.size() + returns.unclassified.size() == scan.size(),
            "a return is in no list, or in two");
        for (std::size_t i = 0; i < scan.size(); ++i) {
            require(std::isnan(scan.range_m[i]) == (returns.label[i] == Label::Unclassified),
                    "what has no range is unclassified, and nothing else");
        }
        return Labels{scan.row, returns.label, returns.component};
    } catch (const std::invalid_argument& e) {
        require(e.what()[0] != '\0', "an error has no message");
        return std::nullopt;
    }
}

void segmentAnything(std::string_view input) {
    Parts parts(input);
    Options options;
    options.columns = 64;
    options.number_obstacles = true;
    setOptions(parts, options);
    SensorModel sensor;
    try {
        sensor = anySensor(parts);
    } catch (const std::invalid_argument&) {
        return;  // too few beams
    }
    std::optional<Attitude> attitude;
    if (parts.chance()) attitude = Attitude{oddNumber(parts), oddNumber(parts)};
    Scan scan;
    // Some arbitrary returns, then a shape with many returns.
    for (std::size_t returns = parts.below(64); returns > 0; --returns) {
        scan.x_m.push_back(oddNumber(parts));
        scan.y_m.push_back(oddNumber(parts));
        scan.z_m.push_back(oddNumber(parts));
    }
    const float height_m = oddNumber(parts), slope = 0.01f * parts.number<std::int8_t>();
    const std::size_t rings = parts.below(16);
    for (std::size_t ring = 0; ring < rings; ++ring) {
        const float range_m = 2.0f + 1.5f * static_cast<float>(ring);
        for (int i = 0; i < 48; ++i) {
            const float angle = 0.1309f * static_cast<float>(i);
            scan.x_m.push_back(range_m * std::cos(angle));
            scan.y_m.push_back(range_m * std::sin(angle));
            scan.z_m.push_back(slope * scan.x_m.back() - height_m);
        }
    }
    scan.intensity.assign(scan.size(), 0.5f);

    // Compares the best instruction set with another one.
    const auto sets = instructionSets();
    const std::size_t other = parts.below(sets.size());
    std::optional<Labels> first;
    for (const std::size_t set : {std::size_t{0}, other}) {
        if (set == 0 && first) break;
        limitInstructionSets(sets[set]);
        const std::optional<Labels> labels = labelsOf(scan, sensor, options, attitude);
        limitInstructionSets("");
        if (!labels) return;
        if (!first) first = labels;
        require(labels->row == first->row, "rows differ with " + sets[set]);
        require(labels->label == first->label, "labels differ with " + sets[set]);
        require(labels->component == first->component, "obstacles differ with " + sets[set]);
    }
}

Seeds scans() {
    const std::string defaults(1, '\0'), vlp16("\2\0\0", 3), level(1, '\0'), no_points(1, '\0');
    const std::string ground =
        std::string("\x10", 1) + bytesOf(std::int16_t{200}, std::int8_t{3}) + '\x0c';
    std::string odd(1, '\x14');
    for (char i = 0; i < 60; ++i) odd += i;
    return {defaults + vlp16 + level + no_points + ground,
            defaults + vlp16 + "\1\7\7" + no_points + ground,
            defaults + vlp16 + level + odd + ground,
            std::string("\3\1\x20\4\x40\5\x60", 7) + vlp16 + level + odd + ground};
}

const bool kAdded = add({"filter", segmentAnything, scans, {}, 600});

}  // namespace
}  // namespace hagen::fuzz
