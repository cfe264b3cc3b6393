// The document generated from the measurements.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "Measurement.h"
#include "selection/Record.h"
#include "support/Tables.h"

namespace hagen {

/// The provenance of the results.
struct Provenance {
    std::string revision;  ///< commit of the project
    std::vector<std::uint64_t> seeds;
    bool is_quick = false;
    std::optional<selection::Record> selection;  ///< from scripts/select-settings, if available
};

/// Returns the Markdown of docs/results.md, with the chart names of drawResults().
std::string documentOf(const std::vector<Measured>& scores, const std::vector<Measured>& times,
                       const Provenance& provenance);

/// Returns the linked tables, by file name in results/.
CsvTables tablesOf(const std::vector<Measured>& scores, const std::vector<Measured>& times,
                   const Provenance& provenance);

}  // namespace hagen
