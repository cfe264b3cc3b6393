// Scores the filter on labelled scan folders, once or over a sweep of settings.
#include <hagen/evaluation/Scores.h>
#include <hagen/observations/ScanFolder.h>
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

/// A setting and the values to try: "beta_deg=5,7.5,10".
struct Sweep {
    std::string key;
    std::vector<std::string> values;
};

Sweep parseSweep(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals + 1 == text.size()) {
        throw CLI::ValidationError("--sweep", "expected KEY=VALUE,VALUE,..., not '" + text + "'");
    }
    return {text.substr(0, equals), CLI::detail::split(text.substr(equals + 1), ',')};
}

Scores evaluate(const std::vector<std::string>& folders, const Settings& settings,
                float max_range_m) {
    Scores scores;
    Scan scan;
    for (const std::string& path : folders) {
        const ScanFolder folder(path);
        Settings own = settings;
        if (std::filesystem::exists(folder.sensorFile())) mergeSettings(folder.sensorFile(), own);
        const SensorModel sensor = own.sensorModel();
        try {
            checkOptions(own.options, sensor.rows());
        } catch (const std::invalid_argument& e) {
            throw SettingsError(path + ": " + e.what());
        }
        HagenFilter filter(sensor, own.options);
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
    std::vector<std::string> folders, configs, sweep_texts;
    float max_range_m = 20.0f;
    app.add_option("-i,--input", folders, "labelled scan folders")->required();
    app.add_option("-c,--config", configs, "settings file; may be repeated, later ones win");
    app.add_option("--sweep", sweep_texts, "KEY=VALUE,VALUE,...: a row for each value");
    app.add_option("--max-range-m", max_range_m, "score returns up to this range")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    try {
        app.parse(argc, argv);
        Settings settings;
        for (const std::string& config : configs) mergeSettings(config, settings);
        std::vector<Sweep> sweeps;
        for (const std::string& text : sweep_texts) sweeps.push_back(parseSweep(text));
        std::printf("%-28s  %29s  %29s\n", "", "RoI precision    recall        F1",
                    "ROU precision    recall        F1");
        if (sweeps.empty()) printRow("all", evaluate(folders, settings, max_range_m));
        for (const Sweep& sweep : sweeps) {
            for (const std::string& value : sweep.values) {
                Settings swept = settings;
                setOption(sweep.key, value, swept);
                printRow(sweep.key + "=" + value, evaluate(folders, swept, max_range_m));
            }
        }
        return 0;
    } catch (const CLI::CallForHelp& e) {
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
