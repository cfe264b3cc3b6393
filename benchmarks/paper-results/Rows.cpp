#include "Rows.h"

#include <stdexcept>

namespace hagen {

const std::string kDefault = "default", kPaper = "paper", kWithoutSurface = "without surface";

namespace {

std::vector<Change> sweep(const std::string& symbol, const std::string& key,
                          const std::vector<std::string>& values) {
    std::vector<Change> changes;
    for (const std::string& value : values) changes.push_back({symbol + " = " + value, key, value});
    return changes;
}

Settings settingsOf(const DataSet& set, const std::filesystem::path& file) {
    Settings settings;
    mergeSettings(file, settings);
    settings.options.zone_m = set.zone_m;
    return settings;
}

/// Checks that the row `paper` uses only the paper's stages.
void checkPaper(const Options& paper, const std::filesystem::path& file) {
    const bool has_no_others = !paper.ground_surface && !paper.level_by_attitude &&
                               paper.seed_gate_deg >= 90 && paper.repair_max_step_m <= 0 &&
                               !paper.bridge_dead_beams && !paper.raw_angles &&
                               paper.context_m <= paper.zone_m;
    if (has_no_others) return;
    throw std::runtime_error(
        file.string() +
        ": has a stage beyond the paper; switch off ground_surface, "
        "level_by_attitude, the seed gate, gap repair, bridge_dead_beams, raw_angles and context "
        "beyond the zone");
}

void addChanges(const std::string& filter, const Settings& settings,
                const std::vector<Change>& changes, std::vector<evaluation::SweepPoint>& rows) {
    for (const Change& change : changes) {
        evaluation::SweepPoint row{nameOf(filter, change), settings, "", ""};
        const auto set = [&](const std::string& key, const std::string& text) {
            // "zone" and "W" are placeholders for the values in the settings.
            const std::string value = text == "zone" ? std::to_string(settings.options.zone_m)
                                      : text == "W"  ? std::to_string(settings.options.window_size)
                                                     : text;
            setOption(key, value, row.settings);
        };
        set(change.key, change.value);
        for (const auto& [key, value] : change.also) set(key, value);
        rows.push_back(row);
    }
}

}  // namespace

std::string nameOf(const std::string& filter, const Change& change) {
    std::string name = filter + ", " + change.key + "=" + change.value;
    for (const auto& [key, value] : change.also) name += ", " + key + "=" + value;
    return name;
}

const std::vector<Change>& betaSweep() {
    static const auto changes = sweep("beta", "beta_deg", {"5", "7.5", "10", "12.5"});
    return changes;
}
const std::vector<Change>& componentSweep() {
    static const auto changes = sweep("PC", "principal_components", {"2", "4", "5", "8"});
    return changes;
}
const std::vector<Change>& toleranceSweep() {
    static const auto changes =
        sweep("tolerance", "ground_tolerance_m",
              {"0", "0.05", "0.1", "0.13", "0.17", "0.2", "0.25", "0.3", "0.4"});
    return changes;
}
const std::map<std::string, std::vector<std::string>>& limitSweeps() {
    static const std::map<std::string, std::vector<std::string>> limits{
        {"Th_dist_m", {"0.1", "0.15", "0.2", "0.25", "0.3", "0.35", "0.4"}},
        {"difference_deg", {"2.5", "4", "5", "6", "7.5", "9", "10"}},
        {"plane_m", {"0.1", "0.15", "0.2", "0.25", "0.3", "0.35", "0.4"}}};
    return limits;
}
std::vector<Change> ablationOf(StageGroup group) {
    std::vector<Change> changes;
    for (const OptionKey& key : optionKeys()) {
        for (const Ablation& off : key.ablations) {
            if (off.group == group) changes.push_back({off.what, key.name, off.value});
        }
    }
    return changes;
}

const std::vector<Change>& paperStagesUnderSurface() {
    static const std::vector<Change> changes{
        {"no labelling: all is ROU for the surface", "seeds", "every"},
        {"no sharpening, no SSA, no labelling",
         "seeds",
         "every",
         {{"persistence_m", "1000"}, {"principal_components", "W"}}}};
    return changes;
}

evaluation::MethodSet headlineRowsFor(const DataSet& set, const std::filesystem::path& config) {
    const Settings ours = settingsOf(set, config / set.preset);
    const Settings paper = settingsOf(set, config / "paper.yaml");
    checkPaper(paper.options, config / "paper.yaml");
    return {{{kDefault, ours, "", ""}, {kPaper, paper, "", ""}}, ours};
}

evaluation::MethodSet rowsFor(const DataSet& set, const std::filesystem::path& config) {
    evaluation::MethodSet all = headlineRowsFor(set, config);
    const Settings ours = all.filter[0].settings, paper = all.filter[1].settings;
    if (set.flights.empty()) {
        addChanges(kDefault, ours, toleranceSweep(), all.filter);
        all.limits = limitSweeps();
    }
    if (!set.has_all_rows) return all;
    for (const auto& changes : {betaSweep(), componentSweep()}) {
        addChanges(kPaper, paper, changes, all.filter);
    }
    for (const auto& changes : {ablationOf(StageGroup::Surface), ablationOf(StageGroup::Own),
                                ablationOf(StageGroup::Paper), paperStagesUnderSurface()}) {
        addChanges(kDefault, ours, changes, all.filter);
    }
    Settings without_surface = ours;
    setOption("ground_surface", "false", without_surface);
    for (const auto& changes : {ablationOf(StageGroup::Own), ablationOf(StageGroup::Paper)}) {
        addChanges(kWithoutSurface, without_surface, changes, all.filter);
    }
    return all;
}

}  // namespace hagen
