// What is scored: the filter with its settings, and what it is compared with.
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <hagen/labelled_scans/Methods.h>
#include "DataSets.h"

namespace hagen {

/// The filter with one setting changed; `what` says it in words.
struct Change {
    std::string what, key, value;
};

/// Names of rows: the two filters, and a filter with a change, as "paper, beta_deg=5".
extern const std::string kDefault, kPaper, kWithoutSurface;
std::string nameOf(const std::string& filter, const Change& change);

/// The paper's own two tables, and its text read literally.
const std::vector<Change>& betaSweep();
const std::vector<Change>& componentSweep();
const Change& literalSeeds();
/// Each stage taken away: of ours, those that work without the ground surface too first.
const std::vector<Change>& ownStages();
const std::vector<Change>& ownStagesOfSurface();
const std::vector<Change>& paperStages();

/// The rows for a data set, with the settings files in `config`; baselines included. Throws
/// std::runtime_error where paper.yaml has a stage of ours on: its figures would not be the
/// paper's.
labelled_scans::MethodRows rowsFor(const DataSet& set, const std::filesystem::path& config);
/// Of these the two filters and the baselines alone.
labelled_scans::MethodRows headlineRowsFor(const DataSet& set, const std::filesystem::path& config);

}  // namespace hagen
