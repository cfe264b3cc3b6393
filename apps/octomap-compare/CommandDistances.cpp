// octomap-compare distances: measures how far off the clearances of world models are.
#include <hagen/avoidance/ClearanceErrors.h>
#include <hagen/avoidance/Distance.h>
#include <hagen/avoidance/WorldModel.h>
#include <hagen/base/NumberText.h>
#include <hagen/base/OutputSet.h>
#include <hagen/base/WriteFile.h>
#include <iostream>
#include <memory>
#include <optional>
#include <tuple>

#include <hagen/base/Interrupt.h>
#include <hagen/base/ProgressLine.h>
#include "Commands.h"

namespace hagen {
namespace {

struct Flags {
    std::string seeds = "0-29", distance = "as-stored", folder;
    std::vector<std::string> models{"all"};
    bool has_specks = false, overwrites = false;
};

std::vector<std::string> modelsFrom(const Flags& flags) {
    std::vector<std::string> all;
    for (const std::string& model : avoidance::worldModelNames()) {
        if (!avoidance::needsTruth(model)) all.push_back(model);
    }
    return namesFrom("--models", flags.models, all);
}

int run(const Flags& flags) {
    const auto one_seed = base::numberFrom<std::uint64_t>(flags.seeds);
    const auto seeds = one_seed ? std::optional(std::pair{*one_seed, *one_seed})
                                : base::numbersFrom<std::uint64_t>(flags.seeds, '-');
    if (!seeds || seeds->second < seeds->first) {
        throw UsageError("--seeds", "'" + flags.seeds + "' is not a seed or a range A-B");
    }
    constexpr std::uint64_t kMostSeeds = 1000000;
    if (seeds->second - seeds->first >= kMostSeeds) {
        throw UsageError("--seeds", "'" + flags.seeds + "' has more than 1 million seeds");
    }
    namespace fs = std::filesystem;
    std::optional<base::OutputPath> csv, markdown;
    if (!flags.folder.empty()) {
        fs::create_directories(flags.folder);
        csv.emplace(fs::path(flags.folder) / "distances.csv", base::kFile, flags.overwrites);
        markdown.emplace(fs::path(flags.folder) / "distances.md", base::kFile, flags.overwrites);
    }
    avoidance::ClearanceMeasurement measurement;
    measurement.models = modelsFrom(flags);
    std::tie(measurement.first_seed, measurement.last_seed) = *seeds;
    measurement.distance = avoidance::distanceFrom(flags.distance);
    measurement.has_specks = flags.has_specks;
    ProgressLine progress("seed");
    measurement.doing = [&](std::uint64_t seed) {
        progress.show(seed - seeds->first, seeds->second - seeds->first + 1);
    };
    measurement.continuing = [] {
        if (isInterrupted()) throw std::runtime_error("interrupted; nothing was written");
    };
    std::vector<avoidance::ClearanceErrors> errors;
    try {
        errors = avoidance::measureClearances(measurement);
    } catch (const std::invalid_argument& e) {
        throw UsageError("--models", e.what());
    }
    const std::string table = avoidance::clearanceMarkdown(errors);
    std::cout << table << "\nBiases, for libs/avoidance/DistanceBias.cpp:\n\n"
              << avoidance::biasTable(errors);
    if (!csv) return 0;
    base::OutputSet outputs;
    outputs.add(*csv);
    outputs.add(*markdown);
    outputs.write(*csv, [&] {
        base::writeText(avoidance::clearanceCsv(errors), csv->temporary(), csv->path());
    });
    outputs.write(*markdown,
                  [&] { base::writeText(table, markdown->temporary(), markdown->path()); });
    outputs.commit();
    std::cout << "\n" << csv->path().string() << "\n" << markdown->path().string() << "\n";
    tellLeftBehind({csv->path(), markdown->path()});
    return 0;
}

}  // namespace

void addDistances(Program& program) {
    const auto flags = std::make_shared<Flags>();
    Command sub = program.subcommand(
        "distances",
        "measure how far off the clearances of world models are, on flights past a "
        "wall and poles");
    sub.option("--seeds", flags->seeds, "seeds of the flights, A-B").showDefault();
    takesWorldModels(
        sub.option("--models", flags->models, "world models (default: all that need no truth)")
            .delimiter(','),
        {"all"});
    sub.option("--distance", flags->distance,
               "as-stored: without any correction; unbiased: with the one that flights use")
        .oneOf({"as-stored", "unbiased"})
        .showDefault();
    sub.flag("--specks", flags->has_specks, "let models take in the returns of dust, too");
    sub.option("-o,--output", flags->folder, "folder for distances.csv and distances.md");
    sub.flag("--overwrite", flags->overwrites, "replace existing files");
    sub.does([flags] { return run(*flags); });
}

}  // namespace hagen
