// The first section of docs/results.md: scores that no setting was chosen on.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "Measurement.h"
#include "selection/Record.h"
#include "support/Tables.h"

namespace hagen {

/// `record` is that of scripts/select-settings; without one, the section reports that. It also
/// reports if the filter or its presets have changed since: if the record's scores of the presets
/// are not the measured ones.
std::string leftOutSection(const std::vector<Measured>& all,
                           const std::optional<selection::Record>& record);
/// The chosen values and the progress of each search.
CsvTables leftOutTables(const std::optional<selection::Record>& record);

}  // namespace hagen
