// The section of docs/results.md on degraded scans.
#pragma once
#include <string>
#include <vector>

#include "Measurement.h"
#include "support/Tables.h"

namespace hagen {

/// Degradations that cost more than this of F1 are marked, in points of 0.01.
constexpr double kCostly_points = 1.5;

/// For each set of scans that were degraded, `default` on the costliest degradations.
std::string hardSection(const std::vector<Measured>& all);
/// The same on all degradations, the costliest first.
CsvTables hardTables(const std::vector<Measured>& all);

}  // namespace hagen
