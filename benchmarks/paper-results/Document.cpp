#include "Document.h"

#include <embree3/rtcore.h>
#include <hagen/evaluation/Breakdown.h>
#include <hagen/evaluation/Latency.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <fstream>

#include "DroneSection.h"
#include "HardSection.h"
#include "LeftOutSection.h"
#include "Rows.h"
#include "Sums.h"
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
    return "## Data\n\n" + table.text() + "Simulated flights have the seeds " + seeds +
           " (ours was tuned on other seeds, 1 and 2), roll and pitch with 4 degrees standard "
           "deviation, and one scan every 6 s. The poses of a flight provide the attitude; "
           "only `default` uses it. Both our own stages and the baselines' `tuned` rows were "
           "tuned on the recordings.\n\n" +
           (those(all, [](const DataSet& set) { return set.flights.empty(); }).empty()
                ? "There are no real scans, because `HAGEN_LABELLED_DATA` was not set.\n\n"
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

/// Lists the methods with higher scores than a filter, per data set.
std::string losses(const std::vector<Measured>& all, const std::string& filter) {
    std::string text;
    for (const Measured& measured : all) {
        const evaluation::Scores own = sumOf({&measured}, filter);
        std::string better;
        for (const std::string& name : headlineNames(all)) {
            if (name == filter || name == kDefault) continue;  // `default` is known to be better
            const evaluation::Scores other = sumOf({&measured}, name);
            const bool is_roi = other.roi.f1() > own.roi.f1();
            const bool is_rou = other.rou.f1() > own.rou.f1();
            if (!is_roi && !is_rou) continue;
            better += (better.empty() ? "" : "; ") + name + " (" +
                      (is_roi && is_rou ? "both"
                       : is_roi         ? "RoI"
                                        : "ROU") +
                      ")";
        }
        if (!better.empty()) text += "- " + measured.set.name + ": " + better + "\n";
    }
    return text.empty() ? "- none\n" : text;
}

/// PCL is optional.
std::string pclNote(const std::vector<Measured>& all) {
    for (const std::string& name : headlineNames(all)) {
        if (name.rfind("pcl", 0) == 0) return "";
    }
    return "The Point Cloud Library was not installed, so its rows are missing.\n\n";
}

std::string headlineSection(const std::vector<Measured>& all) {
    return "## Comparison with other methods\n\n"
           "`paper` is the filter as we read the paper "
           "(`config/paper.yaml`; [paper.md](paper.md) lists other readings), `default` is ours "
           "(`config/vlp16.yaml`, `hdl32e.yaml` or "
           "`hdl64e.yaml`, depending on the sensor). The other methods are described in "
           "[baselines.md](baselines.md). Their `tuned` rows were tuned on the same real "
           "scans that are scored here, which favours them on these scans. The same is true "
           "of `default`, which was also tuned on simulated flights with other seeds: its "
           "figures on real scans are **in-sample** here. Bold marks the highest score of a "
           "row.\n\n" +
           headlineTable(all) + pclNote(all) + wiresTable(all) +
           "Intervals are from a bootstrap over drives (real scans) or flights (simulated "
           "ones), because the scans of one are similar. With six drives, such an interval is "
           "still somewhat narrow, and the figures of the real scans are in-sample; [the left-out "
           "ones](#scores-on-drives-that-were-left-out) are not.\n\n" +
           intervalTable(all) +
           "Other methods with a higher F1 than `paper`, for RoI, ROU or both:\n\n" +
           losses(all, kPaper) + "\nMethods with a higher F1 than `default`:\n\n" +
           losses(all, kDefault) + "\n![F1 of RoI of each scan](results/by_scan.svg)\n\n";
}

// ---- the paper's tables

/// The data of the paper's tables: real scans with 16 beams, and simulated ones.
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

std::string literalTable(const std::vector<Measured>& all) {
    Table table({"F1 of RoI / ROU", "`seeds: lowest`", "`seeds: top_and_nearest`"});
    for (const Measured& measured : all) {
        if (!measured.set.has_all_rows) continue;
        const evaluation::Scores chosen = sumOf({&measured}, kPaper);
        const evaluation::Scores literal = sumOf({&measured}, nameOf(kPaper, literalSeeds()));
        table.add({measured.set.name, pairCell(chosen.roi.f1(), chosen.rou.f1()),
                   pairCell(literal.roi.f1(), literal.rou.f1())});
    }
    return table.text();
}

std::string paperSection(const std::vector<Measured>& all) {
    return "## The paper's tables\n\n"
           "The paper varies beta and PC of the filter and scores "
           "the region of interest over fifty hand-labelled camera images. We do not have "
           "these images, and the cells of its tables are not reproduced here. It "
           "reports the best scores at beta = 10 degrees and PC = 5, and 25 ms per scan on a "
           "laptop. The tables below repeat the variation on other data: `real` is "
           "SemanticKITTI at 16 beams, `simulated` are the flights at 1.5, 2.5 and 4 m. W is "
           "8, so PC = 8 means no smoothing.\n\nOver returns:\n\n" +
           sweepTable(all, betaSweep(), "beta [deg]", &evaluation::MethodScores::returns) +
           sweepTable(all, componentSweep(), "PC", &evaluation::MethodScores::returns) +
           "Over the pixels of a forward-looking camera (`config/camera_forward.yaml`), as in "
           "the paper:\n\n" +
           sweepTable(all, betaSweep(), "beta [deg]", &evaluation::MethodScores::pixels) +
           sweepTable(all, componentSweep(), "PC", &evaluation::MethodScores::pixels) +
           "According to one reading of the paper's text, the topmost and the nearest pixel "
           "of a column seed the region of interest. This table compares that reading with "
           "the one that the filter uses:\n\n" +
           literalTable(all);
}

// ---- run times

/// Lists the methods with a lower median than a filter.
std::string fasterThan(const std::string& filter, const Measured& times) {
    const double own_ms = evaluation::latencyOf(times.row(filter)->latency_ms).p50_ms;
    std::string names;
    for (const evaluation::MethodScores& method : times.methods) {
        const bool is_faster = evaluation::latencyOf(method.latency_ms).p50_ms < own_ms;
        if (is_faster) names += (names.empty() ? "" : ", ") + method.name;
    }
    return "Faster than `" + filter + "`, by p50: " + (names.empty() ? "none" : names) + ".\n\n";
}

std::string timeTable(const Measured& times) {
    Table table({"`" + times.set.name + "`", "mean +- sd [ms]", "p50", "p95", "p99"});
    for (const evaluation::MethodScores& method : times.methods) {
        const evaluation::Latency latency = evaluation::latencyOf(method.latency_ms);
        table.add({method.name, cell(latency.mean_ms, 2) + " +- " + cell(latency.sd_ms, 2),
                   cell(latency.p50_ms, 2), cell(latency.p95_ms, 2), cell(latency.p99_ms, 2)});
    }
    std::size_t returns = 0;
    for (const std::size_t count : times.returns) returns += count;
    return std::to_string(times.scans()) + (times.scans() == 1 ? " scan with " : " scans with ") +
           std::to_string(returns / std::max<std::size_t>(times.scans(), 1)) +
           " returns on average:\n\n" + table.text() + fasterThan(kPaper, times) +
           fasterThan(kDefault, times);
}

std::string timeSection(const std::vector<Measured>& all) {
    std::string text =
        "## Run time\n\n"
        "Run time of the call that labels a scan, in one thread. All "
        "methods process the same scans in the same run, after one warm-up call. The paper "
        "reports 25 ms per scan on a laptop. For fewer than a hundred scans, p99 is the "
        "maximum.\n\n";
    for (const Measured& times : all) text += timeTable(times);
    return text + "![Run time over the number of returns](results/by_returns.svg)\n\n";
}

// ---- ablation

struct Pair {
    double first, second;
};

/// F1 of RoI and ROU; on wires the recall of RoI and of wires, because misses matter there.
Pair ablationPair(const Measured& set, const std::string& row) {
    const evaluation::Scores scores = sumOf({&set}, row);
    if (isWires(set)) return {scores.roi.recall(), recallOfKind(set, row, "wire")};
    return {scores.roi.f1(), scores.rou.f1()};
}

/// One row per change; scores above those of the first row are bold.
std::string ablationTable(const std::vector<Measured>& all, const std::string& first_what,
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
    return table.text();
}

std::string ablationSection(const std::vector<Measured>& all) {
    return "## Ablation\n\n"
           "The `default` filter with one stage removed at a time: first our "
           "stages, then those of the paper. Bold scores are higher without the stage. If "
           "nearly every row equals that of `default`, as with the stages of the paper, the "
           "ground surface compensates for what was removed.\n\n" +
           ablationTable(
               all, "`default`", kDefault, kDefault,
               {ownStagesOfSurface(), ownStages(), paperStages(), paperStagesUnderSurface()}) +
           "The ground surface relabels every pixel and thus hides the effect of earlier "
           "stages. The same without the surface, and therefore also without canopy layer, "
           "extension of obstacles to the ground, speckle filter and tolerances:\n\n" +
           ablationTable(all, "no ground surface", nameOf(kDefault, ownStagesOfSurface().front()),
                         kWithoutSurface, {ownStages(), paperStages()});
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
    return "<!-- Made by scripts/reproduce-paper, which replaces it. -->\n"
           "# Results\n\n"
           "RoI is "
           "the region of interest (what a drone must avoid), ROU the region of uninterest. "
           "Unless stated otherwise, scores are F1 over all returns up to 20 m; "
           "[evaluation.md](evaluation.md) defines them. This page and its figures are "
           "written by `scripts/reproduce-paper`.\n\n" +
           std::string(
               provenance.is_quick
                   ? "**A quick run with few scans, to check that it works: do not cite.**\n\n"
                   : "") +
           leftOutSection(scores, provenance.selection) + headlineSection(scores) +
           droneSection(scores) + hardSection(scores) + paperSection(scores) + timeSection(times) +
           ablationSection(scores) + dataSection(scores, provenance) +
           provenanceSection(provenance);
}

}  // namespace hagen
