#pragma once
#include <hagen/replays/Overhead.h>
#include <hagen/reports/Summary.h>
#include <hagen/trials/FlownRuns.h>
#include <hagen/trials/HeapCurves.h>
#include <hagen/trials/LatencyProfile.h>
#include <optional>
#include <string>
#include <vector>

namespace hagen::reports {

/// All that a report tells of.
struct Report {
    trials::FlownRuns flown;
    Summary summary;
    std::optional<trials::LatencyProfile> profile;
    std::vector<trials::HeapCurve> memory;
    std::vector<replays::OverheadView> worst;
    std::vector<std::string> worst_missing;  ///< which cannot be shown, and why
};

/// One page that needs nothing else: tables and words as HTML, charts by script.
std::string reportPage(const Report& report);

/// The verdict and the main tables, for documents.
std::string reportMarkdown(const Report& report);

}  // namespace hagen::reports
