#include "Document.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include "evaluation/Breakdown.h"
#include "evaluation/Latency.h"
#include "simulation/Embree.h"

#include "DroneSection.h"
#include "HardSection.h"
#include "LeftOutSection.h"
#include "OperatingSection.h"
#include "Rows.h"
#include "Sums.h"
#include "selection/SelectionTables.h"
#include "support/Processor.h"
#include "support/Tables.h"

namespace hagen {
namespace {

bool isWires(const Measured& measured) { return measured.set.name == "wires"; }

// ---- the data

std::string dataSection(const std::vector<Measured>& all, const Provenance& provenance) {
    Table table({"data", "description", "scans", "scored returns"});
    for (const Measured& m : all) {
        table.add({m.set.name, m.set.about, std::to_string(m.scans()),
                   std::to_string(m.scoredReturns())});
    }
    std::string seeds;
    for (const auto seed : provenance.seeds)
        seeds += (seeds.empty() ? "" : ", ") + std::to_string(seed);
    return "## Data\n\n" + table.text() + "Simulated flights use the seeds " + seeds +
           " (tuning used seeds 1 and 2), roll and pitch with a standard deviation of 4 degrees, "
           "and one scan every 6 s. Only `default` uses the attitude.\n\n" +
           (those(all, [](const DataSet& set) { return set.flights.empty(); }).empty()
                ? "Real scans are missing: `HAGEN_LABELLED_DATA` was not set.\n\n"
                : "");
}

// ---- comparison

struct Best {
    double roi = NAN, rou = NAN;
};

std::string headlineTable(const std::vector<Measured>& all) {
    const std::vector<std::string> names = headlineNames(all);
    std::vector<std::string> heads{"F1 of RoI / ROU"};
    heads.insert(heads.end(), names.begin(), names.end());
    Table table(heads);
    for (const Measured& measured : all) {
        Best best;
        for (const std::string& name : names) {
            const evaluation::Scores scores = sumOf({&measured}, name);
            best.roi = std::fmax(best.roi, scores.roi.f1());
            best.rou = std::fmax(best.rou, scores.rou.f1());
        }
        std::vector<std::string> line{measured.set.name};
        for (const std::string& name : names) {
            const evaluation::Scores scores = sumOf({&measured}, name);
            line.push_back(pairCell(scores.roi.f1(), scores.rou.f1(), best.roi, best.rou));
        }
        table.add(line);
    }
    return table.text();
}

std::string wiresTable(const std::vector<Measured>& all) {
    std::string text;
    for (const Measured& measured : all) {
        if (!isWires(measured)) continue;
        Table table({"`wires`, recall within 10 m", "all RoI", "wire", "pole", "precision of RoI"});
        for (const std::string& name : headlineNames(all)) {
            const evaluation::Scores scores = sumOf({&measured}, name);
            table.add({name, cell(scores.roi.recall()), cell(recallOfKind(measured, name, "wire")),
                       cell(recallOfKind(measured, name, "pole")), cell(scores.roi.precision())});
        }
        text += table.text();
    }
    return text;
}

std::string intervalTable(const std::vector<Measured>& all) {
    Table table({"`default`", "drives or flights", "F1 of RoI", "95 % interval", "precision",
                 "recall", "F1 of ROU", "95 % interval"});
    for (const Measured& measured : all) {
        const std::vector<evaluation::Scores> folders = folderSums(measured, kDefault);
        const evaluation::ScoreIntervals intervals = evaluation::bootstrapIntervals(folders);
        const evaluation::Scores scores = sumOf({&measured}, kDefault);
        table.add({measured.set.name, std::to_string(folders.size()), cell(scores.roi.f1()),
                   cell(intervals.roi.f1), cell(scores.roi.precision()), cell(scores.roi.recall()),
                   cell(scores.rou.f1()), cell(intervals.rou.f1)});
    }
    return table.text();
}

/// Lists the methods with higher scores than `default`, per data set.
std::string losses(const std::vector<Measured>& all) {
    std::string text;
    for (const Measured& measured : all) {
        const evaluation::Scores own = sumOf({&measured}, kDefault);
        std::string better;
        for (const std::string& name : headlineNames(all)) {
            const evaluation::Scores other = sumOf({&measured}, name);
            if (other.roi.f1() > own.roi.f1() || other.rou.f1() > own.rou.f1())
                better += (better.empty() ? "" : ", ") + name;
        }
        if (!better.empty()) text += (text.empty() ? "" : "; ") + measured.set.name + ": " + better;
    }
    return text;
}

/// A note on PCL's rows if they are missing, because PCL is optional.
std::string pclNote(const std::vector<Measured>& all) {
    for (const std::string& name : headlineNames(all)) {
        if (name.rfind("pcl", 0) == 0) return "";
    }
    return "The rows of the Point Cloud Library are missing; it was not installed.\n\n";
}

std::string headlineSection(const std::vector<Measured>& all) {
    return "## Comparison with other methods\n\n"
           "`paper` is our reading of the paper (`config/paper.yaml`; [other "
           "readings](paper.md)), `default` our presets (`config/vlp16.yaml`, `hdl32e.yaml` "
           "or `hdl64e.yaml`, depending on the sensor). [baselines.md](baselines.md) describes "
           "the other methods. `default` and the `tuned` rows were tuned on these real scans, so "
           "their scores there are **in-sample**. Bold marks the highest score of a row.\n\n" +
           headlineTable(all) + pclNote(all) + wiresTable(all) +
           "Intervals are from a bootstrap over drives or flights. With six drives, they are "
           "somewhat too narrow.\n\n" +
           intervalTable(all) + "![F1 of RoI of each scan](results/by_scan.svg)\n\n";
}

// ---- the paper's tables

/// The data of the paper's tables: real scans with 16 beams, and simulated scans.
std::vector<std::pair<std::string, Sets>> paperColumns(const std::vector<Measured>& all) {
    const Sets real = those(all, [](const DataSet& set) {
        return set.flights.empty() && set.has_all_rows && set.preset == "vlp16.yaml";
    });
    std::vector<std::pair<std::string, Sets>> columns;
    if (!real.empty()) columns.push_back({"real", real});
    columns.push_back(
        {"simulated", those(all, [](const DataSet& set) { return set.is_altitude; })});
    return columns;
}

const Change& bestOf(const std::vector<Change>& changes, const Sets& sets, ScoreList list) {
    const auto f1 = [&](const Change& c) { return sumOf(sets, nameOf(kPaper, c), list).roi.f1(); };
    return *std::max_element(changes.begin(), changes.end(),
                             [&](const Change& a, const Change& b) { return f1(a) < f1(b); });
}

/// Returns a table of a sweep: precision, recall and F1 of RoI, and the value with the highest F1.
std::string sweepTable(const std::vector<Measured>& all, const std::vector<Change>& changes,
                       const std::string& head, ScoreList list) {
    const auto columns = paperColumns(all);
    std::vector<std::string> heads{head};
    std::string peaks;
    for (const auto& [name, sets] : columns) {
        for (const char* figure : {" precision", " recall", " F1"}) heads.push_back(name + figure);
        peaks += (peaks.empty() ? "" : ", ") + name + " at " + bestOf(changes, sets, list).what;
    }
    Table table(heads);
    for (const Change& change : changes) {
        std::vector<std::string> line{change.value};
        for (const auto& [name, sets] : columns) {
            const evaluation::ClassScore roi = sumOf(sets, nameOf(kPaper, change), list).roi;
            line.insert(line.end(), {cell(roi.precision()), cell(roi.recall()), cell(roi.f1())});
        }
        table.add(line);
    }
    return table.text() + "Highest F1: " + peaks + ".\n\n";
}

std::string paperSection(const std::vector<Measured>& all) {
    return "## The paper's tables\n\n"
           "The paper varies beta and PC and scores RoI on fifty hand-labelled camera images, "
           "which we do not have. It reports the best scores at beta = 10 degrees and PC = 5. "
           "Here the scans are `real` (SemanticKITTI at 16 beams) and `simulated` (the flights "
           "at 1.5, 2.5 and 4 m). W is 8, so PC = 8 means no smoothing.\n\nScored on returns:\n\n" +
           sweepTable(all, betaSweep(), "beta [deg]", &evaluation::MethodScores::returns) +
           sweepTable(all, componentSweep(), "PC", &evaluation::MethodScores::returns) +
           "Scored on the pixels of a forward-looking camera (`config/camera_forward.yaml`), as in "
           "the paper:\n\n" +
           sweepTable(all, betaSweep(), "beta [deg]", &evaluation::MethodScores::pixels) +
           sweepTable(all, componentSweep(), "PC", &evaluation::MethodScores::pixels);
}

// ---- run times

std::size_t meanReturns(const Measured& times) {
    const std::size_t sum =
        std::accumulate(times.returns.begin(), times.returns.end(), std::size_t{0});
    return sum / std::max<std::size_t>(times.scans(), 1);
}

std::string timeTable(const std::vector<Measured>& all) {
    std::vector<std::string> heads{"p50 / p95 [ms]"}, returns{"returns per scan"};
    for (const Measured& times : all) {
        heads.push_back(times.set.name);
        returns.push_back(std::to_string(meanReturns(times)));
    }
    Table table(heads);
    table.add(returns);
    for (const evaluation::MethodScores& method : all.front().methods) {
        std::vector<std::string> line{method.name};
        for (const Measured& times : all) {
            const evaluation::Latency latency =
                evaluation::latencyOf(times.row(method.name)->latency_ms);
            line.push_back(cell(latency.p50_ms, 2) + " / " + cell(latency.p95_ms, 2));
        }
        table.add(line);
    }
    return table.text();
}

Table allTimes(const std::vector<Measured>& all) {
    Table table({"data", "scans", "returns per scan", "method", "mean [ms]", "sd [ms]", "p50 [ms]",
                 "p95 [ms]", "p99 [ms]"});
    for (const Measured& times : all) {
        for (const evaluation::MethodScores& method : times.methods) {
            const evaluation::Latency latency = evaluation::latencyOf(method.latency_ms);
            table.add({times.set.name, std::to_string(times.scans()),
                       std::to_string(meanReturns(times)), method.name, cell(latency.mean_ms, 2),
                       cell(latency.sd_ms, 2), cell(latency.p50_ms, 2), cell(latency.p95_ms, 2),
                       cell(latency.p99_ms, 2)});
        }
    }
    return table;
}

std::string timeSection(const std::vector<Measured>& all) {
    return "## Run time\n\n"
           "Run time of the call that labels a scan, in one thread, after one warm-up call. All "
           "methods process the same scans in the same run. The paper reports 25 ms per scan on "
           "a laptop. With few scans, p95 is the maximum.\n\n" +
           timeTable(all) +
           "[Mean, standard deviation and p99](results/run_time.csv).\n\n"
           "![Run time over the number of returns](results/by_returns.svg)\n\n";
}

// ---- ablation

struct Pair {
    double first, second;
};

/// F1 of RoI and ROU; for wires, the recall of RoI and wires, because misses matter there.
Pair ablationPair(const Measured& set, const std::string& row) {
    const evaluation::Scores scores = sumOf({&set}, row);
    if (isWires(set)) return {scores.roi.recall(), recallOfKind(set, row, "wire")};
    return {scores.roi.f1(), scores.rou.f1()};
}

/// One row per change; scores above those of the first row are bold.
Table ablationTable(const std::vector<Measured>& all, const std::string& first_what,
                    const std::string& first_row, const std::string& filter,
                    const std::vector<std::vector<Change>>& groups) {
    const Sets sets = those(all, [](const DataSet& set) { return set.has_all_rows; });
    std::vector<std::string> heads{"F1 of RoI / ROU"}, first_line{first_what};
    for (const Measured* set : sets) {
        heads.push_back(set->set.name + (isWires(*set) ? ": recall of RoI / wire" : ""));
        const Pair pair = ablationPair(*set, first_row);
        first_line.push_back(pairCell(pair.first, pair.second));
    }
    Table table(heads);
    table.add(first_line);
    for (const auto& changes : groups) {
        for (const Change& change : changes) {
            std::vector<std::string> line{change.what};
            for (const Measured* set : sets) {
                const Pair first = ablationPair(*set, first_row);
                const Pair pair = ablationPair(*set, nameOf(filter, change));
                line.push_back(boldAbove(pair.first, first.first) + " / " +
                               boldAbove(pair.second, first.second));
            }
            table.add(line);
        }
    }
    return table;
}

std::string ablationSection(const std::vector<Measured>& all) {
    return "## Ablation\n\n"
           "`default` with one stage removed at a time: first our stages, then those of the "
           "paper. Bold scores are higher without the stage.\n\n" +
           ablationTable(all, "`default`", kDefault, kDefault,
                         {ablationOf(StageGroup::Surface), ablationOf(StageGroup::Own),
                          ablationOf(StageGroup::Paper), paperStagesUnderSurface()})
               .text() +
           "The ground surface relabels every pixel, which hides the effect of earlier stages. "
           "[The ablation without it](results/ablation_without_surface.csv) also lacks canopy "
           "layer, extension to the ground, speckle filter and tolerances.\n\n";
}

Table ablationWithoutSurface(const std::vector<Measured>& all) {
    return ablationTable(all, "no ground surface",
                         nameOf(kDefault, {"", "ground_surface", "false"}), kWithoutSurface,
                         {ablationOf(StageGroup::Own), ablationOf(StageGroup::Paper)});
}

// ---- provenance

std::string provenanceSection(const Provenance& provenance) {
    Table table({"", ""});
    table.add({"command", std::string("`scripts/reproduce-paper") +
                              (provenance.is_quick ? " --quick`" : "`")});
    table.add({"hagen", std::string(HAGEN_VERSION) + ", " + provenance.revision});
    table.add({"MRPT", HAGEN_MRPT_VERSION});
    table.add({"Eigen", std::to_string(EIGEN_WORLD_VERSION) + "." +
                            std::to_string(EIGEN_MAJOR_VERSION) + "." +
                            std::to_string(EIGEN_MINOR_VERSION)});
    table.add({"Embree", RTC_VERSION_STRING});
    table.add({"compiler", HAGEN_COMPILER});
    table.add({"processor", processor()});
    return "## Provenance\n\n" + table.text();
}

}  // namespace

std::string documentOf(const std::vector<Measured>& scores, const std::vector<Measured>& times,
                       const Provenance& provenance) {
    const std::string better = losses(scores);
    return "<!-- Made by scripts/reproduce-paper, which replaces it. -->\n"
           "# Segmentation results\n\n" +
           std::string(provenance.is_quick
                           ? "**A quick run with few scans, to check that it works: do not "
                             "cite.**\n\n"
                           : "") +
           (provenance.selection ? "- Mean F1 of RoI / ROU on held-out real drives: " +
                                       selection::meanList(*provenance.selection) + ".\n"
                                 : "") +
           (better.empty() ? "- No other method has a higher F1 than `default` on any data set; on "
                             "real scans, `default` is in-sample.\n\n"
                           : "- Methods with a higher F1 than `default`: " + better + ".\n\n") +
           "RoI is the region of interest (what a drone must avoid), ROU the region of "
           "uninterest. Scores are F1 over all returns up to 20 m unless stated otherwise "
           "([definitions](evaluation.md)).\n\n" +
           leftOutSection(scores, provenance.selection) + headlineSection(scores) +
           operatingSection(scores) + droneSection(scores) + hardSection(scores) +
           paperSection(scores) + timeSection(times) + ablationSection(scores) +
           dataSection(scores, provenance) + provenanceSection(provenance);
}

CsvTables tablesOf(const std::vector<Measured>& scores, const std::vector<Measured>& times,
                   const Provenance& provenance) {
    CsvTables tables = leftOutTables(provenance.selection);
    tables.merge(operatingTables(scores));
    tables.merge(droneTables(scores));
    tables.merge(hardTables(scores));
    tables["run_time.csv"] = allTimes(times).csv();
    tables["ablation_without_surface.csv"] = ablationWithoutSurface(scores).csv();
    return tables;
}

}  // namespace hagen
