// The results of an evaluation, summed for the tables, the JSON file and the charts.
#pragma once
#include <hagen/evaluation/Evaluation.h>
#include <string>
#include <vector>
#include "evaluation/Breakdown.h"
#include "evaluation/Latency.h"

#include "evaluation/labelled_folders/HardSets.h"
#include "evaluation/labelled_folders/Methods.h"

namespace hagen::evaluation {

/// Total scores of a group of scans or of parts of scans.
struct GroupTotals {
    std::string name;
    std::size_t scans = 0;
    Scores scores;
    ScoreIntervals intervals;
};

/// Scores over returns or over pixels, in total and by part.
struct ScoreTotals {
    GroupTotals all;
    std::vector<GroupTotals> by_range, by_altitude, by_kind, by_folder;
};

/// A named part of the obstacle returns above 0.5 m: a range band or an object class.
struct MissedGroup {
    std::string name;
    Missed missed;
};

/// The scores for drones, summed over scans.
struct DroneTotals {
    DroneScores all;
    std::vector<MissedGroup> by_range, by_kind;  ///< parts with returns only
};
DroneTotals totalsOf(const std::vector<DroneScores>& scans, const RangeBands& bands);

struct MethodTotals {
    std::string name;
    std::string sweep_key, sweep_value;  ///< empty without a sweep
    Latency latency;
    ScoreTotals returns, pixels;  ///< `pixels` has no scans without a camera
    DroneTotals drone;
};

/// The scores for one degradation.
struct HardSetTotals {
    std::string name;
    /// As in Summary::methods, without --labels; `returns` has totals only.
    std::vector<MethodTotals> methods;
};

/// A run of the program: its parameters and results.
struct Summary {
    std::vector<std::string> command_line;
    std::vector<std::string> folders;       ///< paths
    std::vector<std::string> folder_names;  ///< short names
    std::vector<std::string> sensor_texts;  ///< per folder; empty if settings name the sensor
    /// Per folder: the settings merged with those of its recording, and ignored requests.
    std::vector<Settings> folder_settings;
    std::vector<std::vector<std::string>> folder_remarks;
    Settings settings;  ///< as requested
    RangeBands range;
    std::string label_map, camera;  ///< files, or empty
    BootstrapOptions bootstrap;
    std::size_t scans = 0;
    std::vector<MethodTotals> methods;
    std::vector<HardSetTotals> hard_sets;
};

/// Sums the scores, computes intervals with the options in `summary`, and fills in its methods.
void addScores(const std::vector<MethodScores>& methods, const std::vector<SweepPoint>& rows,
               Summary& summary);

/// Like addScores(), but for degraded scans and without intervals.
void addHardSets(const std::vector<HardSet>& sets, Summary& summary);

/// Change of F1 from recorded to degraded scans, in points (hundredths).
double changeInPoints(double degraded, double recorded);

}  // namespace hagen::evaluation
