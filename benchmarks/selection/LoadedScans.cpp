#include "LoadedScans.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include "evaluation/DegradedScans.h"
#include "evaluation/labelled_folders/LabelledFolders.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>

#include "Plan.h"

namespace hagen::selection {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

Settings settingsOf(const fs::path& preset, float zone_m) {
    Settings settings;
    mergeSettings(preset, settings);
    settings.options.zone_m = zone_m;
    return settings;
}

std::unique_ptr<evaluation::LabelledScanSource> sourceOf(
    const ScanInputs& inputs, const std::optional<evaluation::LabelMap>& label_map) {
    const evaluation::MethodSet rows{{{"", settingsOf(inputs.preset, inputs.zone_m), "", ""}},
                                     std::nullopt};
    auto source = std::move(evaluation::sourcesOf({inputs.folder}, rows, label_map).front());
    if (inputs.degradation.empty()) return source;
    return std::make_unique<evaluation::DegradedScans>(std::move(source),
                                                       evaluation::Degradation(inputs.degradation));
}

evaluation::Scores scoresOf(const evaluation::GroundTruthScan& scan,
                            const std::vector<Label>& found, float max_range_m) {
    evaluation::Scores scores;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (scan.input.scan.range_m[i] <= max_range_m)
            evaluation::addScore(scan.truth[i], found[i], scores);
    }
    return scores;
}

}  // namespace

std::size_t LoadedScans::kindOf(const ScanInputs& inputs, bool is_upside_down) {
    const fs::path sensor_file = fs::path(inputs.folder) / "sensor.yaml";
    const Kind kind{inputs.preset, sensor_file, contentOf(sensor_file), inputs.zone_m,
                    is_upside_down};
    const auto same = [&](const Kind& k) {
        return k.preset == kind.preset && k.sensor == kind.sensor && k.zone_m == kind.zone_m &&
               k.is_upside_down == kind.is_upside_down;
    };
    const auto found = std::find_if(kinds_.begin(), kinds_.end(), same);
    const auto index = static_cast<std::size_t>(found - kinds_.begin());
    if (found == kinds_.end()) kinds_.push_back(kind);
    return index;
}

std::size_t LoadedScans::setOf(const ScanSet& set) {
    const auto found = std::find_if(sets_.begin(), sets_.end(), [&](const ScanSet& s) {
        return s.vote == set.vote && s.drive == set.drive;
    });
    const auto index = static_cast<std::size_t>(found - sets_.begin());
    if (found == sets_.end()) sets_.push_back(set);
    return index;
}

void LoadedScans::add(const ScanInputs& inputs) {
    const bool is_upside_down =
        !inputs.degradation.empty() && evaluation::Degradation(inputs.degradation).mirrorsSensor();
    const std::size_t kind = kindOf(inputs, is_upside_down);
    const std::size_t first = scans_.size();
    for (const ScanInputs::Truth& truth : inputs.truths) {
        const std::size_t set = setOf(truth.set);
        const auto source = sourceOf(inputs, truth.label_map);
        for (std::size_t i = first; auto pulled = source->next(); ++i) {
            if (i == scans_.size()) scans_.push_back({kind, {}});
            auto loaded =
                std::make_unique<Truth>(Truth{set, inputs.max_range_m, std::move(*pulled), {}});
            // Missed returns by class are not needed, and counting them is slow.
            loaded->scan.kinds.clear();
            loaded->drone = std::make_unique<evaluation::DroneTruth>(
                loaded->scan, evaluation::RangeBands{inputs.max_range_m});
            scans_[i].truths.push_back(std::move(loaded));
        }
    }
}

evaluation::Method LoadedScans::methodFor(const Kind& kind, const std::vector<Setting>& settings,
                                          const Choice& choice) {
    Settings chosen = settingsOf(kind.preset, kind.zone_m);
    apply(settings, choice, chosen);
    evaluation::MethodSet rows{{{"", chosen, "", ""}}, std::nullopt};
    rows.is_upside_down = kind.is_upside_down;
    return evaluation::methodsFor(rows, kind.sensor_file).front();
}

std::vector<Counts> LoadedScans::measure(const std::vector<Setting>& settings,
                                         const Choice& choice) const {
    using Methods = std::map<std::size_t, evaluation::Method>;  // by kind
    tbb::enumerable_thread_specific<Methods> methods;           // filters are not thread-safe
    std::vector<std::vector<Counts>> counts(scans_.size());
    tbb::parallel_for(std::size_t{0}, scans_.size(), [&](std::size_t s) {
        const LoadedScan& scan = scans_[s];
        Methods& own = methods.local();
        auto method = own.find(scan.kind);
        if (method == own.end()) {
            method = own.emplace(scan.kind, methodFor(kinds_[scan.kind], settings, choice)).first;
        }
        const std::vector<Label> found = method->second.segment(scan.truths.front()->scan.input);
        for (const auto& truth : scan.truths) {
            counts[s].push_back({scoresOf(truth->scan, found, truth->max_range_m),
                                 truth->drone->score(found, {}).tall});
        }
    });
    std::vector<Counts> sums(sets_.size());
    for (std::size_t s = 0; s < scans_.size(); ++s) {
        for (std::size_t t = 0; t < counts[s].size(); ++t)
            sums[scans_[s].truths[t]->set] += counts[s][t];
    }
    return sums;
}

}  // namespace hagen::selection
