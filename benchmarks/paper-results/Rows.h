// The scored methods: the filter with its settings, and the baselines.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "DataSets.h"
#include "evaluation/labelled_folders/Methods.h"
#include "filter/OptionKeys.h"

namespace hagen {

/// The filter with changed settings; `what` describes the change.
struct Change {
    std::string what, key, value;
    std::vector<std::pair<std::string, std::string>> also = {};  ///< further keys and their values
};

/// Names of rows: the two filters, or a filter with a change, for example "paper, beta_deg=5".
extern const std::string kDefault, kPaper, kWithoutSurface;
std::string nameOf(const std::string& filter, const Change& change);

/// The two sweeps of the paper.
const std::vector<Change>& betaSweep();
const std::vector<Change>& componentSweep();
/// Switches off each stage of a group in turn (OptionKeys.h).
std::vector<Change> ablationOf(StageGroup group);
/// Changes that require the ground surface: without it, all returns would be ROU.
const std::vector<Change>& paperStagesUnderSurface();

/// The sweeps of the operating curves: the filter's tolerance, and the limits of the baselines. Row
/// names begin with "default, ground_tolerance_m=", "zermas, Th_dist_m=", ...
const std::vector<Change>& toleranceSweep();
const std::map<std::string, std::vector<std::string>>& limitSweeps();

/// Returns the rows for a data set, with the settings files in `config`, including the baselines;
/// for recordings, also those of the operating curves. Throws std::runtime_error if paper.yaml
/// enables a stage that is not in the paper.
evaluation::MethodSet rowsFor(const DataSet& set, const std::filesystem::path& config);
/// Like rowsFor(), but only the two filters and the baselines.
evaluation::MethodSet headlineRowsFor(const DataSet& set, const std::filesystem::path& config);

}  // namespace hagen
