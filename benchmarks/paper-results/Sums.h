// Sums over scans and data sets, for the tables.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "Measurement.h"

namespace hagen {

using ScoreList = std::vector<evaluation::ScanScores> evaluation::MethodScores::*;
using Sets = std::vector<const Measured*>;

/// Returns the scans of a row in several sets, concatenated; empty if a set lacks the row.
std::vector<evaluation::ScanScores> scansOf(const Sets& sets, const std::string& row,
                                            ScoreList list = &evaluation::MethodScores::returns);
evaluation::Scores sumOf(const Sets& sets, const std::string& row,
                         ScoreList list = &evaluation::MethodScores::returns);
/// Returns the sums over the scans of each folder (a drive or a flight).
std::vector<evaluation::Scores> folderSums(const Measured& measured, const std::string& row);
/// Returns the summed drone scores; nullopt if a set lacks the row.
evaluation::DroneScores droneSumOf(const Sets& sets, const std::string& row);
double recallOfKind(const Measured& set, const std::string& row, const std::string& kind);

Sets those(const std::vector<Measured>& all, bool (*choose)(const DataSet&));
/// Returns the names of the two filters and the baselines.
std::vector<std::string> headlineNames(const std::vector<Measured>& all);

/// Returns the named data sets in the tables of missed obstacles: every set that has all rows. The
/// flights of the altitude series (`is_altitude`) are merged into one entry.
std::vector<std::pair<std::string, Sets>> mainData(const std::vector<Measured>& all);

}  // namespace hagen
