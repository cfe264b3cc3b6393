// Scores the filter on labelled scan folders, once or over a sweep of settings.
#include <hagen/evaluation/Scores.h>
#include <hagen/logs/ScanFolder.h>
#include <hagen/observations/Settings.h>
#include <hagen/segmentation/HagenFilter.h>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace hagen;

/// A row of the table: a name, and the settings it is about.
struct Row {
    std::string name;
    Settings settings;
};

/// Adds a row for each value of "beta_deg=5,7.5,10".
void addSweep(const std::string& text, const Settings& settings, std::vector<Row>& rows) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals + 1 == text.size()) {
        throw CLI::ValidationError("--sweep", "expected KEY=VALUE,VALUE,..., not '" + text + "'");
    }
    const std::string key = text.substr(0, equals);
    for (const std::string& value : CLI::detail::split(text.substr(equals + 1), ',')) {
        Row row{key + "=" + value, settings};
        setOption(key, value, row.settings);
        rows.push_back(row);
    }
}

/// Throws where settings ask for what this program does not do.
void checkWindow(const Settings& settings) {
    if (settings.options.window_scans > 1) {
        throw SettingsError("window_scans is above 1; scans are scored one by one here");
    }
}

Scores evaluate(const std::vector<std::string>& folders, const Settings& settings,
                float max_range_m) {
    Scores scores;
    Scan scan;
    for (const std::string& path : folders) {
        const ScanFolder folder(path);
        Settings own = settings;
        if (std::filesystem::exists(folder.sensorFile())) mergeSettings(folder.sensorFile(), own);
        HagenFilter filter = filterFor(own.sensorModel(), own.options);
        for (std::size_t i = 0; i < folder.size(); ++i) {
            readScan(folder.scanFile(i), scan);
            locateBeams(filter.sensor(), scan);
            const SegmentationResult& result = filter.segment(scan);
            try {
                addScores(scan, readLabels(folder.labelFile(i)), result.returns.label, max_range_m,
                          scores);
            } catch (const std::invalid_argument& e) {
                throw std::runtime_error(folder.labelFile(i).string() + ": " + e.what());
            }
        }
    }
    return scores;
}

void printHeader() {
    std::printf("%-28s  %29s  %29s\n", "", "RoI precision    recall        F1",
                "ROU precision    recall        F1");
}

/// Four digits, or a dash for what is not defined.
std::string figure(double ratio) {
    char text[16] = "-";
    if (!std::isnan(ratio)) std::snprintf(text, sizeof text, "%.4f", ratio);
    return text;
}

void printRow(const std::string& what, const Scores& scores) {
    std::printf("%-28s", what.c_str());
    for (const ClassScore& score : {scores.roi, scores.rou}) {
        std::printf("  %9s %9s %9s", figure(score.precision()).c_str(),
                    figure(score.recall()).c_str(), figure(score.f1()).c_str());
    }
    std::printf("\n");
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
    std::vector<std::string> folders, configs, sweep_texts;
    float max_range_m = 20.0f;
    app.add_option("-i,--input", folders, "labelled scan folders")->required();
    app.add_option("-c,--config", configs, "settings file; may be repeated, later ones win");
    app.add_option("--sweep", sweep_texts,
                   "KEY=VALUE,VALUE,...: a row for each value; each sweep by itself");
    app.add_option("--max-range-m", max_range_m, "score returns up to this range")
        ->capture_default_str()
        ->check(CLI::Range(0.1, 1000.0));
    try {
        app.parse(argc, argv);
        Settings settings;
        for (const std::string& config : configs) mergeSettings(config, settings);
        std::vector<Row> rows;
        if (sweep_texts.empty()) rows.push_back({"all", settings});
        for (const std::string& text : sweep_texts) addSweep(text, settings, rows);
        for (const Row& row : rows) checkWindow(row.settings);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const Scores scores = evaluate(folders, rows[i].settings, max_range_m);
            if (i == 0) printHeader();
            printRow(rows[i].name, scores);
        }
        return 0;
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
