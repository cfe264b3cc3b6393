// Scores the filter on labelled scan folders, with one setting or a sweep of them.
#include <hagen/evaluation/Evaluation.h>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "Folders.h"
#include "Methods.h"
#include "Report.h"
#include "Summary.h"

namespace {

using namespace hagen;

struct Flags {
    std::vector<std::string> folders, configs, sweeps;
    std::string label_map, camera, overlay, json, charts;
    float max_range_m = 20.0f;
    int resamples = 1000;
    bool overwrite = false;
};

void addFlags(CLI::App& app, Flags& flags) {
    app.add_option("-i,--input", flags.folders, "labelled scan folders")->required();
    app.add_option("-c,--config", flags.configs, "settings file; may be repeated, later ones win");
    app.add_option("--sweep", flags.sweeps,
                   "KEY=VALUE,VALUE,...: a row for each value; each sweep by itself");
    app.add_option("--max-range-m", flags.max_range_m, "score returns up to this range")
        ->capture_default_str()
        ->check(CLI::Range(0.1, 1000.0));
    app.add_option("--label-map", flags.label_map,
                   "YAML file: which classes of semantic/ (or else labels/) are RoI and ROU");
    app.add_option("--bootstrap", flags.resamples, "resamples for intervals; 0: no intervals")
        ->capture_default_str()
        ->check(CLI::Range(0, 1000000));
}

/// A file that a flag names and that cannot be taken as it is is wrong usage.
template <class Read>
auto fromFlag(Read read) {
    try {
        return read();
    } catch (const std::runtime_error& e) {
        throw SettingsError(e.what());
    }
}

int run(const Flags& flags, Summary summary) {
    for (const std::string& config : flags.configs) mergeSettings(config, summary.settings);
    const std::vector<SettingsRow> rows = rowsOf(summary.settings, flags.sweeps);
    std::optional<LabelMap> label_map;
    if (!flags.label_map.empty()) {
        label_map = fromFlag([&] { return readLabelMap(flags.label_map); });
    }
    const std::vector<ScanSource> sources = sourcesOf(flags.folders, rows, label_map);

    EvaluationOptions options;
    options.range.max_range_m = flags.max_range_m;
    const std::vector<MethodScores> methods = evaluate(sources, options);

    summary.folders = flags.folders;
    for (const ScanSource& source : sources) summary.folder_names.push_back(source.name);
    summary.range = options.range;
    summary.label_map = flags.label_map;
    summary.camera = flags.camera;
    summary.bootstrap.resamples = flags.resamples;
    sumUp(methods, rows, summary);
    std::cout << reportOf(summary);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Score the filter on labelled scan folders (KITTI layout; labels 1 ROU, 2 RoI)."};
    app.footer(
        "Prints precision, recall and F1 of each class over all returns of all scans; returns with "
        "true label 0 are left out.\n"
        "Example:\n"
        "  segmentation-evaluate -i scans/* -c config/paper.yaml --sweep beta_deg=5,7.5,10");
    app.set_version_flag("--version", "segmentation-evaluate " HAGEN_VERSION);
    Flags flags;
    addFlags(app, flags);
    try {
        app.parse(argc, argv);
        Summary summary;
        summary.command_line.assign(argv, argv + argc);
        return run(flags, summary);
    } catch (const CLI::Success& e) {
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        app.exit(e);
        return 2;
    } catch (const SettingsError& e) {
        std::cerr << "segmentation-evaluate: " << e.what() << "\n";
        return 2;
    } catch (const std::exception& e) {
        std::cerr << "segmentation-evaluate: " << e.what() << "\n";
        return 1;
    }
}
