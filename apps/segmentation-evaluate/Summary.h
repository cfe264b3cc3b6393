// What an evaluation found, summed up for the tables, the JSON file and the charts.
#pragma once
#include <hagen/evaluation/Breakdown.h>
#include <hagen/evaluation/Evaluation.h>
#include <hagen/evaluation/Latency.h>
#include <filesystem>
#include <string>
#include <vector>

#include "Methods.h"

namespace hagen {

/// The scores of a group of scans, or of parts of scans.
struct SummedGroup {
    std::string name;
    std::size_t scans = 0;
    Scores scores;
    ScoreIntervals intervals;
};

/// Scores over returns or over pixels, in all and in parts.
struct SummedScores {
    SummedGroup all;
    std::vector<SummedGroup> by_range, by_altitude, by_kind, by_folder;
};

struct SummedMethod {
    std::string name;
    std::string sweep_key, sweep_value;  ///< of a sweep, else empty
    Latency latency;
    SummedScores returns, pixels;  ///< pixels: zero scans where no camera was given
};

/// A run of the program: what it was asked, and what it found.
struct Summary {
    std::vector<std::string> command_line;
    std::vector<std::string> folders;       ///< paths
    std::vector<std::string> folder_names;  ///< short
    Settings settings;
    RangeBands range;
    std::string label_map, camera;  ///< files, or empty
    BootstrapOptions bootstrap;
    std::size_t scans = 0;
    std::vector<SummedMethod> methods;
};

/// Sums up, and computes intervals, by the options in `summary`; its methods are filled.
void sumUp(const std::vector<MethodScores>& methods, const std::vector<SettingsRow>& rows,
           Summary& summary);

}  // namespace hagen
