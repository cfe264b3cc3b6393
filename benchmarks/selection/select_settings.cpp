// Chooses the filter's settings by leave-one-drive-out selection, and writes docs/selection.json.
// Run by scripts/select-settings.
#include <hagen/base/OutputPath.h>
#include <hagen/evaluation/LabelMap.h>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include "base/WriteFile.h"

#include "LoadedScans.h"
#include "Plan.h"
#include "Record.h"
#include "SelectionTables.h"
#include "base/command_line/CommandLine.h"
#include "paper-results/DataSets.h"

namespace {

using namespace hagen;
using namespace hagen::base;
using namespace hagen::selection;
namespace fs = std::filesystem;

/// Flights without published results, partly used to develop the stages.
const std::vector<std::uint64_t> kSeeds{1, 2};
constexpr int kScansPerFlight = 3;
const std::string kHardFlights = "simulated, 2.5 m";

struct Flags {
    std::string labelled, data, config, plan, output, revision = "unknown", simulation = "unknown";
    bool is_quick = false, overwrite = false;
};

void addFlags(Command& app, Flags& flags) {
    app.option("-o,--output", flags.output, "result file (JSON), docs/selection.json").required();
    app.option("--labelled", flags.labelled,
               "folder with beams16/ and beams64/: labelled real scans, one folder per drive")
        .required()
        .existingFolder();
    app.option("--data", flags.data, "folder for simulated scans; existing scans are reused")
        .required();
    app.option("--config", flags.config, "the project's folder of settings files")
        .required()
        .existingFolder();
    app.option("--plan", flags.plan,
               "candidate values, see config/selection.yaml (default: selection.yaml of --config)");
    app.option("--revision", flags.revision, "revision of the project, for the record");
    app.option("--simulation", flags.simulation,
               "version of the simulation; scans of other versions are simulated again");
    app.flag("--quick", flags.is_quick, "one scan per flight, for testing");
    app.flag("--overwrite", flags.overwrite, "replace an existing file");
}

/// Adds the drives of a data set as recorded, with and without vegetation, and degraded.
void addDrives(const DataSet& set, const evaluation::LabelMap& without_vegetation,
               const std::string& without_name, const fs::path& config, const Plan& plan,
               LoadedScans& scans) {
    for (const std::string& folder : scanFolders(set)) {
        const std::string drive = fs::path(folder).filename().string();
        ScanInputs inputs{folder, config / set.preset, set.zone_m, set.max_range_m, "", {}};
        inputs.truths = {
            {{set.name + ", " + drive, drive, Group::Real, true}, std::nullopt},
            {{without_name + ", " + drive, drive, Group::Real, false}, without_vegetation}};
        scans.add(inputs);
        for (const std::string& hard : plan.hard_sets) {
            inputs.degradation = hard;
            inputs.truths = {{{hard + ", " + set.name, drive, Group::Hard, true}, std::nullopt}};
            scans.add(inputs);
        }
    }
}

void addFlights(const DataSet& set, const fs::path& config, const Plan& plan, LoadedScans& scans) {
    for (const std::string& folder : scanFolders(set)) {
        ScanInputs inputs{folder, config / set.preset, set.zone_m, set.max_range_m, "", {}};
        inputs.truths = {{{set.name, "", Group::Simulated, true}, std::nullopt}};
        scans.add(inputs);
        if (set.name != kHardFlights) continue;
        for (const std::string& hard : plan.hard_sets) {
            inputs.degradation = hard;
            inputs.truths = {{{hard + ", simulated", "", Group::Hard, true}, std::nullopt}};
            scans.add(inputs);
        }
    }
}

/// The data set of each vote.
using DataOfVotes = std::map<std::string, std::string>;

LoadedScans load(const Flags& flags, const Plan& plan, DataOfVotes& data) {
    LoadedScans scans;
    const std::vector<DataSet> sets =
        dataSets(flags.labelled, flags.data, {kSeeds, flags.is_quick ? 1 : kScansPerFlight});
    for (const DataSet& set : sets) {
        const bool is_real = set.flights.empty();
        if (!is_real && set.has_all_rows) {
            makeFlights(set, flags.simulation);
            addFlights(set, flags.config, plan, scans);
        }
        if (!is_real || !set.has_vegetation) continue;
        for (const DataSet& other : sets) {
            if (other.folder != set.folder || other.has_vegetation) continue;
            addDrives(set, evaluation::readLabelMap(fs::path(flags.config) / other.label_map),
                      other.name, flags.config, plan, scans);
            for (const std::string& folder : scanFolders(set)) {
                const std::string drive = fs::path(folder).filename().string();
                for (const DataSet* one : {&set, &other})
                    data[one->name + ", " + drive] = one->name;
            }
        }
    }
    return scans;
}

/// Descents from one start, with all drives and with each drive held out.
struct Searched {
    Search record;
    std::map<std::string, Choice> choices;  ///< by held-out drive
};

Searched search(const std::string& start_name, const Choice& start, const Choice& present,
                const Plan& plan, const std::vector<ScanSet>& sets, CachedMeasure& measure) {
    Searched all{{start_name, {}}, {}};
    std::vector<std::string> left_out{""};
    for (const std::string& drive : drivesOf(sets)) left_out.push_back(drive);
    for (const std::string& drive : left_out) {
        const MissedByGroup limit = missedOf(sets, measure(present), drive);
        const Descended d =
            descend(plan.settings, start, limit, sets, measure, drive, plan.max_rounds);
        Fold fold{drive, {}, d.start, d.objective, d.missed_start, d.missed, limit, d.rounds};
        for (std::size_t s = 0; s < plan.settings.size(); ++s)
            fold.chosen.push_back(plan.settings[s].values[d.choice[s]]);
        all.record.folds.push_back(fold);
        all.choices[drive] = d.choice;
        std::cerr << "from " << start_name << ", "
                  << (drive.empty() ? "with all drives" : "without drive " + drive)
                  << ": objective " << d.start << " to " << d.objective << ", "
                  << measure.measured() << " choices measured so far\n";
    }
    return all;
}

int run(const Flags& flags) {
    const fs::path config = flags.config;
    Plan plan = readPlan(flags.plan.empty() ? config / "selection.yaml" : fs::path(flags.plan));
    const Choice present = presentChoice({config / "vlp16.yaml", config / "hdl64e.yaml"}, plan);
    base::OutputPath output(flags.output, base::kFile, flags.overwrite);
    DataOfVotes data;
    const LoadedScans scans = load(flags, plan, data);
    const std::vector<ScanSet>& sets = scans.sets();
    if (drivesOf(sets).size() < 2) {
        throw std::runtime_error(flags.labelled +
                                 ": has a single drive; leaving one out requires at least 2");
    }
    std::cerr << scans.scans() << " scans in memory, in " << sets.size() << " sets\n";

    CachedMeasure measure([&](const Choice& c) { return scans.measure(plan.settings, c); });
    const std::vector<Searched> searches{
        search("the presets", present, present, plan, sets, measure),
        search("a plain start", plainChoice(plan, present), present, plan, sets, measure)};

    Record record{
        flags.revision, kSeeds, plan.hard_sets, scans.scans(), measure.measured(), {}, {}, {}};
    for (std::size_t s = 0; s < plan.settings.size(); ++s) {
        const Setting& setting = plan.settings[s];
        record.settings.push_back({setting.key, setting.values[present[s]], setting.values});
    }
    for (const Searched& searched : searches) record.searches.push_back(searched.record);
    for (std::size_t s = 0; s < sets.size(); ++s) {
        const auto real = data.find(sets[s].vote);
        if (real == data.end()) continue;
        DriveScores scores{real->second, sets[s].drive, measure(present)[s], {}, {}};
        for (const Searched& searched : searches) {
            scores.with_all.push_back(measure(searched.choices.at(""))[s]);
            scores.left_out.push_back(measure(searched.choices.at(sets[s].drive))[s]);
        }
        record.scores.push_back(scores);
    }
    std::stable_sort(record.scores.begin(), record.scores.end(),
                     [](const DriveScores& a, const DriveScores& b) { return a.data < b.data; });
    base::writeText(jsonOf(record), output.temporary(), output.path());
    output.commit();
    std::cout << scoreTable(record);
    for (const Search& one : record.searches)
        std::cout << "From " << one.start << ":\n\n"
                  << choiceTable(record, one).text() << foldTable(one).text();
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Program program("select-settings",
                    "Chooses the filter's settings on real drives and simulated flights, holding "
                    "out one drive at a time, and scores each drive with the settings chosen "
                    "without it.");
    program.footer("Exit codes: 0 success, 1 runtime error, 2 wrong usage.");
    Flags flags;
    addFlags(program, flags);
    return program.run(argc, argv, [&] { return run(flags); });
}
