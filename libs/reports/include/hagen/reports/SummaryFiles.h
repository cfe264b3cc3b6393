#pragma once
#include <hagen/reports/Summary.h>
#include <hagen/trials/FlownRuns.h>
#include <string>

namespace hagen::reports {

/// summary.json: the whole summary and how much of the campaign is done. NaN is written as null.
std::string summaryJson(const Summary& summary, const trials::FlownRuns& flown);

/// summary.csv: one row per cell of one scenario.
std::string summaryCsv(const Summary& summary);

}  // namespace hagen::reports
