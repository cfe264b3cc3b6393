#pragma once
#include <hagen/reports/Summary.h>
#include <hagen/trials/FlownRuns.h>
#include <string>

namespace hagen::reports {

/// summary.json: all of a summary, and how much of its campaign is flown; what is NaN is null.
std::string summaryJson(const Summary& summary, const trials::FlownRuns& flown);

/// summary.csv: one row per cell.
std::string summaryCsv(const Summary& summary);

}  // namespace hagen::reports
