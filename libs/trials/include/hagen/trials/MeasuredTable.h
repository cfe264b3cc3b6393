#pragma once
#include <hagen/trials/RunTable.h>
#include <hagen/trials/TrialMeasurement.h>
#include <string>

namespace hagen::trials {

/// A row of measured.csv: what a run cost on the machine that flew it. Columns: the run's key
/// (keyHeader()), then filter_p50_ms,filter_p95_ms, the same of update, guidance and planner
/// (CPU time), and peak_model_bytes (heap). A stage that did not run has empty fields. The row of a
/// run with sectors ends with one more, `updates`.
std::string measuredHeader();
std::string measuredRowOf(const Run& run, const TrialMeasurement& measurement);

/// Header and row as in a table in which a run needsAllColumns().
std::string fullMeasuredHeader();
std::string fullMeasuredRowOf(const std::string& row);

/// The key of the run that a row belongs to; "" for an empty row.
std::string keyOfMeasuredRow(const std::string& row);

}  // namespace hagen::trials
