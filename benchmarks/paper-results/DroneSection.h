// The section of docs/results.md on missed obstacles and false alarms.
#pragma once
#include <string>
#include <vector>

#include "Measurement.h"
#include "support/Tables.h"

namespace hagen {

/// The fractions of missed returns and obstacles, and the false alarms, of all methods.
std::string droneSection(const std::vector<Measured>& all);
/// The counts of all methods, and the missed returns of `default` by range and by class.
CsvTables droneTables(const std::vector<Measured>& all);

}  // namespace hagen
