// Scores and run times of every row on every data set.
#pragma once
#include <hagen/evaluation/Evaluation.h>
#include <filesystem>
#include <string>
#include <vector>

#include "DataSets.h"

namespace hagen {

/// What the rows reached on a data set.
struct Measured {
    DataSet set;
    std::vector<std::string> folders;               ///< names of its scan folders
    std::vector<evaluation::MethodScores> methods;  ///< a row each
    std::vector<std::size_t> returns;               ///< of each scan

    /// The row of this name, or nullptr.
    const evaluation::MethodScores* row(const std::string& name) const;
    /// Scans, and how many of their returns are scored.
    std::size_t scans() const { return returns.size(); }
    std::int64_t scoredReturns() const;
};

struct MeasurementOptions {
    std::filesystem::path config;  ///< the folder of settings files, label maps and cameras
    std::string simulation_tag;    ///< see makeFlights()
    unsigned jobs = 1;             ///< data sets that are scored at the same time
};

/// Makes what is missing of the sets, and scores every row on each.
std::vector<Measured> measureScores(const std::vector<DataSet>& sets,
                                    const MeasurementOptions& options);

/// Takes the run times of the methods side by side on the sets that are made for it: one set after
/// the other, nothing else running. Its scores count for nothing more than measureScores()'s.
std::vector<Measured> measureTimes(const std::vector<DataSet>& sets,
                                   const MeasurementOptions& options);

}  // namespace hagen
