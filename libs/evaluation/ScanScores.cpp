#include <hagen/evaluation/ScanScores.h>
#include <algorithm>
#include <stdexcept>
#include "base/NumberText.h"

namespace hagen::evaluation {
namespace {

constexpr float kMaxBands = 1e6f;  // because each band stores scores

}  // namespace

void checkSizes(std::size_t returns, std::size_t labels, const std::string& what) {
    if (labels == returns) return;
    throw std::invalid_argument("the numbers of " + what + " (" + std::to_string(labels) +
                                ") and returns (" + std::to_string(returns) + ") differ");
}

Eigen::Matrix3f GroundTruthScan::levelFromSensor() const {
    if (true_level_from_sensor) return *true_level_from_sensor;
    return input.map_from_sensor.value_or(Eigen::Matrix3f::Identity());
}

std::size_t RangeBands::count() const {
    const float bands = std::ceil(max_range_m / width_m);
    if (!(bands <= kMaxBands)) {  // true for NaN
        throw std::invalid_argument("a range of " + base::shortestText(max_range_m) +
                                    " m has too many bands of " + base::shortestText(width_m) +
                                    " m");
    }
    return static_cast<std::size_t>(std::max(1.0f, bands));
}

std::size_t RangeBands::bandOf(float range_m) const {
    return std::min(static_cast<std::size_t>(range_m / width_m), count() - 1);
}

std::string RangeBands::nameOf(std::size_t band) const {
    const float from_m = static_cast<float>(band) * width_m;
    return base::shortestText(from_m) + "-" +
           base::shortestText(std::min(from_m + width_m, max_range_m)) + " m";
}

ScanScores scoreScan(const GroundTruthScan& scan, const std::vector<Label>& found,
                     const LabelMap& kinds, const RangeBands& bands,
                     const std::vector<std::size_t>* chosen) {
    const std::vector<float>& range_m = scan.input.scan.range_m;
    checkSizes(range_m.size(), scan.truth.size(), "ground-truth labels");
    checkSizes(range_m.size(), found.size(), "found labels");
    if (!scan.kinds.empty()) checkSizes(range_m.size(), scan.kinds.size(), "kinds");

    ScanScores scores;
    scores.altitude_m = scan.altitude_m;
    scores.by_range.resize(bands.count());
    std::map<std::uint16_t, Scores> by_kind;
    const auto add = [&](std::size_t i) {
        if (scan.truth[i] == Label::Unclassified || !(range_m[i] <= bands.max_range_m)) return;
        addScore(scan.truth[i], found[i], scores.all);
        addScore(scan.truth[i], found[i], scores.by_range[bands.bandOf(range_m[i])]);
        if (!scan.kinds.empty()) addScore(scan.truth[i], found[i], by_kind[scan.kinds[i]]);
    };
    if (chosen != nullptr) {
        for (const std::size_t i : *chosen) add(i);
    } else {
        for (std::size_t i = 0; i < range_m.size(); ++i) add(i);
    }
    for (const auto& [number, of_kind] : by_kind) {
        const auto kind = kinds.find(number);
        if (kind == kinds.end()) {
            throw std::invalid_argument("class " + std::to_string(number) +
                                        " has no name in the label map; add a line for it");
        }
        scores.by_kind[kind->second.name] += of_kind;
    }
    return scores;
}

}  // namespace hagen::evaluation
