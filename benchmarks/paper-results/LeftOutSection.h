// The first section of docs/results.md: held-out scores.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "Measurement.h"
#include "selection/Record.h"
#include "support/Tables.h"

namespace hagen {

/// `record` is from scripts/select-settings. The section reports a record that is missing, or
/// outdated because its scores of the presets differ from the measured scores.
std::string leftOutSection(const std::vector<Measured>& all,
                           const std::optional<selection::Record>& record);
/// The chosen values and the progress of each search.
CsvTables leftOutTables(const std::optional<selection::Record>& record);

}  // namespace hagen
