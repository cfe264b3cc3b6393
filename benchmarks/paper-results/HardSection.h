// The section of docs/results.md on degraded scans.
#pragma once
#include <string>
#include <vector>

#include "Measurement.h"
#include "support/Tables.h"

namespace hagen {

/// Minimum loss of F1 for a degradation to be listed, in units of 0.01.
constexpr double kCostly_points = 1.5;

/// The scores of `default` with the worst degradations of each degraded set.
std::string hardSection(const std::vector<Measured>& all);
/// Like hardSection(), but for all degradations, the worst first.
CsvTables hardTables(const std::vector<Measured>& all);

}  // namespace hagen
