// The results of an evaluation, summed for the tables, the JSON file and the charts.
#pragma once
#include <hagen/evaluation/Breakdown.h>
#include <hagen/evaluation/Evaluation.h>
#include <hagen/evaluation/Latency.h>
#include <filesystem>
#include <string>
#include <vector>

#include "Methods.h"

namespace hagen::labelled_scans {

/// Total scores of a group of scans or of parts of scans.
struct GroupTotals {
    std::string name;
    std::size_t scans = 0;
    evaluation::Scores scores;
    evaluation::ScoreIntervals intervals;
};

/// Scores over returns or over pixels, in total and by part.
struct ScoreTotals {
    GroupTotals all;
    std::vector<GroupTotals> by_range, by_altitude, by_kind, by_folder;
};

/// A named part of the obstacle returns above 0.5 m: a range band or an object class.
struct MissedGroup {
    std::string name;
    evaluation::Missed missed;
};

/// What matters to a drone, summed over scans.
struct DroneTotals {
    evaluation::DroneScores all;
    std::vector<MissedGroup> by_range, by_kind;  ///< without empty parts
};
DroneTotals totalsOf(const std::vector<evaluation::DroneScores>& scans,
                     const evaluation::RangeBands& bands);

struct MethodTotals {
    std::string name;
    std::string sweep_key, sweep_value;  ///< key of the sweep; empty: no sweep
    evaluation::Latency latency;
    ScoreTotals returns, pixels;  ///< pixels: zero scans without a camera
    DroneTotals drone;
};

/// A run of the program: its parameters and results.
struct Summary {
    std::vector<std::string> command_line;
    std::vector<std::string> folders;       ///< paths
    std::vector<std::string> folder_names;  ///< short
    observations::Settings settings;
    evaluation::RangeBands range;
    std::string label_map, camera;  ///< files, or empty
    evaluation::BootstrapOptions bootstrap;
    std::size_t scans = 0;
    std::vector<MethodTotals> methods;
};

/// Sums the scores and computes intervals with the options in `summary`, and fills its methods.
void addScores(const std::vector<evaluation::MethodScores>& methods,
               const std::vector<SweepPoint>& rows, Summary& summary);

}  // namespace hagen::labelled_scans
