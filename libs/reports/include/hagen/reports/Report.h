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

/// All data of a report.
struct Report {
    trials::FlownRuns flown;
    Summary summary;
    std::optional<trials::LatencyProfile> profile;
    std::vector<trials::HeapCurve> memory;
    std::vector<replays::OverheadView> worst;
    std::vector<std::string> worst_missing;  ///< runs that cannot be shown, and why
};

/// A self-contained HTML page: text, tables, and charts drawn by a script.
std::string reportPage(const Report& report);

/// The verdict and the main tables as Markdown.
std::string reportMarkdown(const Report& report);

}  // namespace hagen::reports
