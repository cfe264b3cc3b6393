// The section of docs/results.md on the tolerance for ground: precision over recall.
#pragma once
#include <string>
#include <vector>

#include "Measurement.h"
#include "support/Tables.h"

namespace hagen {

/// Scores of RoI of a method with one value of its limit for ground.
struct OperatingPoint {
    std::string setting;  ///< such as "Th_dist_m=0.2"
    double precision, recall;
    evaluation::Missed tall;
};

/// The points of `default` or a baseline in a set, in the order of the sweep.
std::vector<OperatingPoint> operatingCurve(const Measured& set, const std::string& method);
/// Returns the names of `default` and the baselines.
std::vector<std::string> operatingMethods(const Measured& set);
/// The highest recall of the line through the points at this precision or above; NaN if all of it
/// is below.
double recallAt(double precision, const std::vector<OperatingPoint>& curve);

/// Empty without real scans, as all methods on simulated ones have one point.
std::string operatingSection(const std::vector<Measured>& all);
CsvTables operatingTables(const std::vector<Measured>& all);

}  // namespace hagen
