// Scores the filter on labelled scan folders, with one setting or a sweep of them.
#include <hagen/base/OutputPath.h>
#include <hagen/evaluation/Evaluation.h>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <hagen/labelled_scans/Charts.h>
#include <hagen/labelled_scans/LabelledFolders.h>
#include <hagen/labelled_scans/Methods.h>
#include <hagen/labelled_scans/Overlay.h>
#include <hagen/labelled_scans/Summary.h>
#include <hagen/labelled_scans/SummaryJson.h>
#include "Progress.h"
#include "Report.h"

namespace {

using namespace hagen;
namespace fs = std::filesystem;

struct Flags {
    std::vector<std::string> folders, configs, sweeps;
    std::string label_map, camera, overlay, json, charts;
    float max_range_m = 20.0f;
    int resamples = 1000;
    bool with_baselines = false, overwrite = false;
};

void addFlags(CLI::App& app, Flags& flags) {
    app.add_option("-i,--input", flags.folders, "labelled scan folders")->required();
    app.add_option("-c,--config", flags.configs, "settings file; may be repeated, later ones win");
    app.add_option("--sweep", flags.sweeps,
                   "KEY=VALUE,VALUE,...: a row for each value; each sweep by itself");
    app.add_flag("--baselines", flags.with_baselines,
                 "rows of segmenters of others, as published and as tuned");
    app.add_option("--max-range-m", flags.max_range_m, "score returns up to this range")
        ->capture_default_str()
        ->check(CLI::Range(0.1, 1000.0));
    app.add_option("--label-map", flags.label_map,
                   "YAML file: which classes of semantic/ (or else labels/) are RoI and ROU");
    const auto camera =
        app.add_option("--camera", flags.camera,
                       "YAML file of a camera: scores its pixels too, as the paper does");
    app.add_option("--overlay", flags.overlay,
                   "folder for a PNG a scan of what the camera sees: hits, misses, false alarms")
        ->needs(camera);
    app.add_option("--json", flags.json, "file for all figures, counts and intervals");
    app.add_option("--charts", flags.charts, "folder for SVG charts");
    app.add_option("--bootstrap", flags.resamples, "resamples for intervals; 0: no intervals")
        ->capture_default_str()
        ->check(CLI::Range(0, 1000000));
    app.add_flag("--overwrite", flags.overwrite, "replace outputs that exist");
}

/// A file that a flag names and that cannot be taken as it is is wrong usage.
template <class Read>
auto fromFlag(const std::string& file, Read read) -> std::optional<decltype(read(file))> {
    if (file.empty()) return std::nullopt;
    try {
        return read(file);
    } catch (const std::runtime_error& e) {
        throw observations::SettingsError(e.what());
    }
}

/// The places to write to, each where it was asked for. Nothing appears before all is written.
struct Outputs {
    explicit Outputs(const Flags& flags) {
        base::checkApart({flags.json, flags.charts, flags.overlay},
                         {flags.folders.begin(), flags.folders.end()});
        const auto open = [&](const std::string& path, const base::OutputKind& kind,
                              std::optional<base::OutputPath>& output) {
            if (path.empty()) return;
            output.emplace(path, kind, flags.overwrite);
            if (kind.holds != nullptr) fs::create_directory(output->temporary());
        };
        open(flags.json, base::kFile, json);
        open(flags.charts, labelled_scans::kCharts, charts);
        open(flags.overlay, labelled_scans::kOverlays, overlay);
    }
    void commit() {
        for (std::optional<base::OutputPath>* output : {&json, &charts, &overlay}) {
            if (output->has_value()) (*output)->commit();
        }
    }
    std::optional<base::OutputPath> json, charts, overlay;
};

int run(const Flags& flags, labelled_scans::Summary summary) {
    for (const std::string& config : flags.configs)
        observations::mergeSettings(config, summary.settings);
    labelled_scans::MethodRows rows{labelled_scans::rowsOf(summary.settings, flags.sweeps),
                                    std::nullopt};
    if (flags.with_baselines) rows.baselines = summary.settings;
    const auto label_map = fromFlag(flags.label_map, evaluation::readLabelMap);
    evaluation::EvaluationOptions options;
    options.range.max_range_m = flags.max_range_m;
    options.camera = fromFlag(flags.camera, evaluation::readCamera);
    const std::vector<evaluation::ScanSource> sources =
        labelled_scans::sourcesOf(flags.folders, rows, label_map);
    Outputs outputs(flags);

    std::vector<evaluation::MethodScores> methods;
    {
        Progress progress(sources);
        methods = evaluation::evaluate(sources, options, [&](const evaluation::LabelledView& view) {
            progress.show(view);
            if (!outputs.overlay) return;
            labelled_scans::drawOverlay(outputs.overlay->temporary(), sources[view.source], view,
                                        options);
        });
    }

    summary.folders = flags.folders;
    for (const evaluation::ScanSource& source : sources)
        summary.folder_names.push_back(source.name);
    summary.range = options.range;
    summary.label_map = flags.label_map;
    summary.camera = flags.camera;
    summary.bootstrap.resamples = flags.resamples;
    labelled_scans::sumUp(methods, rows.filter, summary);
    if (outputs.json) labelled_scans::writeJson(outputs.json->temporary(), summary);
    if (outputs.charts) labelled_scans::drawCharts(outputs.charts->temporary(), summary);
    outputs.commit();
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
        "  segmentation-evaluate -i scans/* -c config/paper.yaml --sweep beta_deg=5,7.5,10\n"
        "  segmentation-evaluate -i scans/* --baselines --label-map config/semantic_kitti.yaml "
        "--json "
        "all.json");
    app.set_version_flag("--version", "segmentation-evaluate " HAGEN_VERSION);
    Flags flags;
    addFlags(app, flags);
    try {
        app.parse(argc, argv);
        labelled_scans::Summary summary;
        summary.command_line.assign(argv, argv + argc);
        return run(flags, summary);
    } catch (const CLI::Success& e) {
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        app.exit(e);
        return 2;
    } catch (const observations::SettingsError& e) {
        std::cerr << "segmentation-evaluate: " << e.what() << "\n";
        return 2;
    } catch (const std::exception& e) {
        std::cerr << "segmentation-evaluate: " << e.what() << "\n";
        return 1;
    }
}
