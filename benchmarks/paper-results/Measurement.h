// Scores and run times of every row on every data set.
#pragma once
#include <hagen/evaluation/Evaluation.h>
#include <filesystem>
#include <string>
#include <vector>

#include "DataSets.h"
#include "evaluation/labelled_folders/HardSets.h"

namespace hagen {

/// The results of all rows on a data set.
struct Measured {
    DataSet set;
    std::vector<std::string> folders;               ///< names of the scan folders
    std::vector<evaluation::MethodScores> methods;  ///< one per row
    std::vector<std::size_t> returns;               ///< number of returns of each scan
    /// Scores of `default` on degraded copies of the scans; empty unless the set is_degraded.
    std::vector<evaluation::HardSet> hard_sets;

    /// Returns the row of this name, or nullptr.
    const evaluation::MethodScores* row(const std::string& name) const;
    /// Number of scans, and of scored returns.
    std::size_t scans() const { return returns.size(); }
    std::int64_t scoredReturns() const;
};

struct MeasurementOptions {
    std::filesystem::path config;  ///< the folder of settings files, label maps and cameras
    std::string simulation_tag;    ///< see makeFlights()
    unsigned jobs = 1;             ///< data sets or degradations scored in parallel
};

/// Simulates missing sets and scores every row on each set.
std::vector<Measured> measureScores(const std::vector<DataSet>& sets,
                                    const MeasurementOptions& options);

/// Scores `default` on degraded copies of the sets with is_degraded: one task per set and standard
/// degradation.
void measureHardSets(std::vector<Measured>& all, const MeasurementOptions& options);

/// Measures run times of the methods on the sets with is_timed, strictly sequentially. The scores
/// equal those of measureScores() and are not used.
std::vector<Measured> measureTimes(const std::vector<DataSet>& sets,
                                   const MeasurementOptions& options);

}  // namespace hagen
