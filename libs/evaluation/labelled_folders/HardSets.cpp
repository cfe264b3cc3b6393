#include "evaluation/labelled_folders/HardSets.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace hagen::evaluation {
namespace {

/// Opens the folders, without precomputed labels, which do not apply to degraded scans.
LabelledScanSources open(const LabelledInputs& inputs, bool is_upside_down) {
    MethodSet rows = inputs.rows;
    rows.labels.clear();
    rows.is_upside_down = is_upside_down;
    return sourcesOf(inputs.folders, rows, inputs.label_map);
}

void addNew(const Degradation& degradation, std::vector<Degradation>& all) {
    const bool is_known = std::any_of(all.begin(), all.end(), [&](const auto& other) {
        return other.name() == degradation.name();
    });
    if (!is_known) all.push_back(degradation);
}

}  // namespace

std::vector<Degradation> degradationsOf(const std::vector<std::string>& texts, bool with_standard,
                                        const LabelledInputs& inputs) {
    std::vector<Degradation> all;
    if (texts.empty() && !with_standard) return all;
    const LabelledScanSources sources = open(inputs, false);
    if (with_standard) {
        const auto coarsest = std::min_element(
            sources.begin(), sources.end(),
            [](const auto& a, const auto& b) { return a->sensor().rows() < b->sensor().rows(); });
        all = standardDegradations((*coarsest)->sensor());
    }
    std::string folder;
    try {
        for (const std::string& text : texts) addNew(Degradation(text), all);
        for (const auto& source : sources) {
            folder = source->name() + ": ";
            for (const Degradation& degradation : all) degradation.checkSensor(source->sensor());
        }
    } catch (const std::invalid_argument& e) {
        throw SettingsError("--degrade: " + folder + e.what());
    }
    return all;
}

std::vector<HardSet> scoreHardSets(const LabelledInputs& inputs,
                                   const std::vector<Degradation>& degradations,
                                   const RangeBands& range, const HardSetListener& listener) {
    std::vector<HardSet> sets;
    for (const Degradation& degradation : degradations) {
        LabelledScanSources sources = open(inputs, degradation.mirrorsSensor());
        for (auto& source : sources) {
            source = std::make_unique<DegradedScans>(std::move(source), degradation);
        }
        const auto show = [&](const MethodOutput& output) {
            if (listener) listener(degradation.name(), output);
        };
        sets.push_back({degradation.name(), evaluate(sources, {range, {}}, show)});
    }
    return sets;
}

}  // namespace hagen::evaluation
