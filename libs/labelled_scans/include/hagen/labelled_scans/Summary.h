// What an evaluation found, summed up for the tables, the JSON file and the charts.
#pragma once
#include <hagen/evaluation/Breakdown.h>
#include <hagen/evaluation/Evaluation.h>
#include <hagen/evaluation/Latency.h>
#include <filesystem>
#include <string>
#include <vector>

#include "Methods.h"

namespace hagen::labelled_scans {

/// The scores of a group of scans, or of parts of scans.
struct SummedGroup {
    std::string name;
    std::size_t scans = 0;
    evaluation::Scores scores;
    evaluation::ScoreIntervals intervals;
};

/// Scores over returns or over pixels, in all and in parts.
struct SummedScores {
    SummedGroup all;
    std::vector<SummedGroup> by_range, by_altitude, by_kind, by_folder;
};

struct SummedMethod {
    std::string name;
    std::string sweep_key, sweep_value;  ///< of a sweep, else empty
    evaluation::Latency latency;
    SummedScores returns, pixels;  ///< pixels: zero scans where no camera was given
};

/// A run of the program: what it was asked, and what it found.
struct Summary {
    std::vector<std::string> command_line;
    std::vector<std::string> folders;       ///< paths
    std::vector<std::string> folder_names;  ///< short
    observations::Settings settings;
    evaluation::RangeBands range;
    std::string label_map, camera;  ///< files, or empty
    evaluation::BootstrapOptions bootstrap;
    std::size_t scans = 0;
    std::vector<SummedMethod> methods;
};

/// Sums up, and computes intervals, by the options in `summary`; its methods are filled.
void sumUp(const std::vector<evaluation::MethodScores>& methods,
           const std::vector<SettingsRow>& rows, Summary& summary);

}  // namespace hagen::labelled_scans
