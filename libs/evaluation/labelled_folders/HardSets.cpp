#include <hagen/evaluation/HardSets.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace hagen::evaluation {
namespace {

/// The folders, without labels that are not of degraded scans.
evaluation::LabelledScanSources open(const LabelledInputs& inputs, bool is_upside_down) {
    MethodSet rows = inputs.rows;
    rows.labels.clear();
    rows.is_upside_down = is_upside_down;
    return sourcesOf(inputs.folders, rows, inputs.label_map);
}

void addNew(const evaluation::Degradation& degradation, std::vector<evaluation::Degradation>& all) {
    const bool is_known = std::any_of(all.begin(), all.end(), [&](const auto& other) {
        return other.name() == degradation.name();
    });
    if (!is_known) all.push_back(degradation);
}

}  // namespace

std::vector<evaluation::Degradation> degradationsOf(const std::vector<std::string>& texts,
                                                    bool with_standard,
                                                    const LabelledInputs& inputs) {
    std::vector<evaluation::Degradation> all;
    if (texts.empty() && !with_standard) return all;
    const evaluation::LabelledScanSources sources = open(inputs, false);
    if (with_standard) {
        const auto coarsest = std::min_element(
            sources.begin(), sources.end(),
            [](const auto& a, const auto& b) { return a->sensor().rows() < b->sensor().rows(); });
        all = evaluation::standardDegradations((*coarsest)->sensor());
    }
    std::string folder;
    try {
        for (const std::string& text : texts) addNew(evaluation::Degradation(text), all);
        for (const auto& source : sources) {
            folder = source->name() + ": ";
            for (const evaluation::Degradation& degradation : all)
                degradation.checkSensor(source->sensor());
        }
    } catch (const std::invalid_argument& e) {
        throw SettingsError("--degrade: " + folder + e.what());
    }
    return all;
}

std::vector<HardSet> scoreHardSets(const LabelledInputs& inputs,
                                   const std::vector<evaluation::Degradation>& degradations,
                                   const evaluation::RangeBands& range,
                                   const HardSetListener& listener) {
    std::vector<HardSet> sets;
    for (const evaluation::Degradation& degradation : degradations) {
        evaluation::LabelledScanSources sources = open(inputs, degradation.mirrorsSensor());
        for (auto& source : sources) {
            source = std::make_unique<evaluation::DegradedScans>(std::move(source), degradation);
        }
        const auto show = [&](const evaluation::MethodOutput& output) {
            if (listener) listener(degradation.name(), output);
        };
        sets.push_back({degradation.name(), evaluation::evaluate(sources, {range, {}}, show)});
    }
    return sets;
}

}  // namespace hagen::evaluation
