// Scores the filter on labelled scan folders, with one set of settings or a sweep.
#include <hagen/evaluation/Evaluation.h>
#include <hagen/filter/ResultCheck.h>
#include <hagen/settings/Presets.h>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>
#include "base/OutputSet.h"

#include "Progress.h"
#include "Report.h"
#include "base/command_line/CommandLine.h"
#include "base/command_line/Interrupt.h"
#include "base/command_line/Terminal.h"
#include "evaluation/labelled_folders/Charts.h"
#include "evaluation/labelled_folders/HardSets.h"
#include "evaluation/labelled_folders/LabelledFolders.h"
#include "evaluation/labelled_folders/Methods.h"
#include "evaluation/labelled_folders/Summary.h"
#include "evaluation/labelled_folders/SummaryJson.h"

namespace {

using namespace hagen;
using namespace hagen::base;
namespace fs = std::filesystem;

struct Flags {
    std::vector<std::string> folders, configs, keys, sweeps, labels, degradations;
    std::string label_map, camera, json, charts;
    float max_range_m = 20.0f;
    int resamples = 1000;
    bool with_baselines = false, with_hard_sets = false, overwrite = false;
};

void addFlags(Command& app, Flags& flags) {
    app.option("DIR,-i,--input", flags.folders, "labelled scan folders").required().existingPath();
    app.option("-c,--config", flags.configs,
               "settings file, or the name of a preset such as hdl32e; may be repeated, later ones "
               "override earlier ones");
    app.option("--set", flags.keys, "KEY=VALUE: one key of the settings; may be repeated").once();
    app.option("--sweep", flags.sweeps,
               "KEY=VALUE,VALUE,...: one row per value; sweeps are independent");
    app.flag("--baselines", flags.with_baselines,
             "add rows of published segmenters, original and tuned");
    app.option("--labels", flags.labels,
               "NAME=DIR: also score the label files of another program; may be repeated")
        .once();
    app.flag("--hard-sets", flags.with_hard_sets,
             "also score degraded copies of all scans: dead beams, rain, tilt, ...");
    app.option("--degrade", flags.degradations,
               "SPEC: also score one such copy, as in dropout=20; may be repeated; an invalid SPEC "
               "lists all SPECs")
        .once();
    app.option("--max-range-m", flags.max_range_m, "score returns up to this range")
        .showDefault()
        .between(0.1, 1000.0);
    app.option("--label-map", flags.label_map,
               "YAML file or preset: maps the classes of semantic/ (or labels/) to RoI and ROU");
    app.option("--camera", flags.camera,
               "camera (YAML file or preset): also score its pixels, as in the paper");
    app.option("--json", flags.json, "JSON file: scores, counts and intervals");
    app.option("--charts", flags.charts, "folder for SVG charts");
    app.option("--bootstrap", flags.resamples, "bootstrap resamples for intervals; 0: no intervals")
        .showDefault()
        .between(0, 1000000);
    app.flag("--overwrite", flags.overwrite, "replace existing outputs");
}

/// Reads a file or preset given by a flag, and adds it to the list of read files. Reports an
/// unusable file as wrong usage.
template <class Read>
auto fromFlag(const std::string& name, Read read, std::vector<fs::path>& files)
    -> std::optional<decltype(read(name))> {
    if (name.empty()) return std::nullopt;
    const auto is_usable = [&](const fs::path& file) {
        try {
            read(file.string());
            return true;
        } catch (const std::runtime_error&) {
            return false;
        }
    };
    try {
        files.push_back(presetFile(name, is_usable));
        return read(files.back().string());
    } catch (const std::runtime_error& e) {
        throw SettingsError(e.what());
    }
}

/// The outputs, which are renamed into place at the end. A failed output does not affect the
/// others.
struct Outputs {
    Outputs(const Flags& flags, const evaluation::MethodSet& rows, std::vector<fs::path> inputs) {
        inputs.insert(inputs.end(), flags.folders.begin(), flags.folders.end());
        for (const evaluation::LabelRow& row : rows.labels) inputs.push_back(row.folder);
        base::checkApart({flags.json, flags.charts}, inputs);
        const auto open = [&](const std::string& path, const base::OutputKind& kind,
                              std::optional<base::OutputPath>& output) {
            if (path.empty()) return;
            output.emplace(path, kind, flags.overwrite);
            if (kind.holds != nullptr) fs::create_directory(output->temporary());
            all.add(*output);
        };
        open(flags.json, base::kFile, json);
        open(flags.charts, evaluation::kCharts, charts);
    }
    /// Writes an output, or a part of it, if requested.
    void write(const std::optional<base::OutputPath>& output,
               const std::function<void(const fs::path&)>& step) {
        if (output) all.write(*output, [&] { step(output->temporary()); });
    }

    std::optional<base::OutputPath> json, charts;
    base::OutputSet all;
};

void endIfInterrupted() {
    if (isInterrupted()) throw std::runtime_error("interrupted; no output was written");
}

int run(const Flags& flags, evaluation::Summary summary) {
    catchSignals();
    for (const std::string& config : flags.configs)
        mergeSettings(presetFile(config), summary.settings);
    for (const std::string& key : flags.keys) mergeKey(key, summary.settings);
    evaluation::MethodSet rows;
    rows.filter = evaluation::rowsOf(summary.settings, flags.sweeps);
    if (flags.with_baselines) rows.baselines = summary.settings;
    evaluation::addLabelRows(flags.labels, rows);
    std::vector<fs::path> settings_files = summary.settings.files;
    const evaluation::LabelledInputs inputs{
        flags.folders, rows, fromFlag(flags.label_map, evaluation::readLabelMap, settings_files)};
    evaluation::EvaluationOptions options;
    options.range.max_range_m = flags.max_range_m;
    options.camera = fromFlag(flags.camera, evaluation::readCamera, settings_files);
    for (const evaluation::SweepPoint& row : rows.filter) {
        const float zone_m = row.settings.options.zone_m;
        if (zone_m >= flags.max_range_m) continue;
        std::cerr << row.name << ": WARNING: obstacles beyond zone_m (" << zone_m
                  << " m) count as missed; to score only nearer returns: --max-range-m " << zone_m
                  << "\n";
    }
    const evaluation::LabelledScanSources sources =
        evaluation::sourcesOf(inputs.folders, inputs.rows, inputs.label_map);
    const std::vector<evaluation::Degradation> degradations =
        evaluation::degradationsOf(flags.degradations, flags.with_hard_sets, inputs);
    Outputs outputs(flags, rows, std::move(settings_files));

    std::vector<evaluation::MethodScores> methods;
    std::vector<evaluation::HardSet> hard_sets;
    std::vector<ResultCheck> checks(sources.size());  // of the filter's first row
    {
        Progress progress(sources, 1 + degradations.size());
        methods = evaluation::evaluate(sources, options, [&](const evaluation::MethodOutput& view) {
            endIfInterrupted();
            progress.show(view);
            if (view.method == 0 && !rows.filter.empty()) {
                checks[view.source].add(view.truth.input.scan, view.found,
                                        sources[view.source]->sensor(),
                                        rows.filter.front().settings.options);
            }
        });
        hard_sets = evaluation::scoreHardSets(
            inputs, degradations, options.range,
            [&](const std::string& degradation, const evaluation::MethodOutput& view) {
                endIfInterrupted();
                progress.show(view, degradation + ": ");
            });
    }

    summary.folders = flags.folders;
    for (const auto& source : sources) {
        summary.folder_names.push_back(source->name());
        summary.sensor_texts.push_back(source->sensorText());
        summary.folder_settings.push_back(evaluation::settingsOf(*source, summary.settings));
        summary.folder_remarks.push_back(source->remarks());
    }
    summary.range = options.range;
    summary.label_map = flags.label_map;
    summary.camera = flags.camera;
    summary.bootstrap.resamples = flags.resamples;
    summary.bootstrap.continuing = endIfInterrupted;
    evaluation::addScores(methods, rows.filter, summary);
    evaluation::addHardSets(hard_sets, summary);
    outputs.write(outputs.json,
                  [&](const fs::path& file) { evaluation::writeJson(file, summary); });
    outputs.write(outputs.charts,
                  [&](const fs::path& folder) { evaluation::drawCharts(folder, summary); });
    endIfInterrupted();
    for (std::size_t f = 0; f < summary.folders.size(); ++f) {
        for (const std::string& remark : summary.folder_remarks[f]) {
            std::cerr << summary.folders[f] << ": " << oneLine(remark) << "\n";
        }
        for (const std::string& warning : checks[f].warnings()) {
            std::cerr << summary.folders[f] << ": WARNING: " << warning << "\n";
        }
    }
    std::cout << reportOf(summary) << std::flush;
    outputs.all.commit();
    return 0;
}

int command(int argc, char** argv) {
    Program program(
        "segmentation-evaluate",
        "Score the filter on labelled scan folders (KITTI layout; labels 1 ROU, 2 RoI).");
    program.footer(
        "Prints precision, recall and F1 of each class over all returns of all scans;\n"
        "returns with ground-truth label 0 are excluded.\n"
        "Example:\n"
        "  segmentation-evaluate scans/* -c paper --sweep beta_deg=5,7.5,10\n"
        "  segmentation-evaluate scans/* --baselines --json all.json");
    program.version(HAGEN_VERSION);
    Flags flags;
    addFlags(program, flags);
    return program.run(argc, argv, [&] {
        evaluation::Summary summary;
        summary.command_line.assign(argv, argv + argc);
        try {
            return run(flags, summary);
        } catch (const SettingsError& e) {
            return program.fail(kWrongUsage, e.what());
        }
    });
}

}  // namespace

int main(int argc, char** argv) { return guarded(argc, argv, command); }
