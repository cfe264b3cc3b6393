#pragma once
#include <hagen/trials/LatencyProfile.h>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "FlownRuns.h"
#include "Overhead.h"
#include "Summary.h"

namespace hagen {

/// What a model held along a flight.
struct MemoryCurve {
    std::string model;
    std::vector<std::pair<double, double>> bytes_by_path_m;  ///< path [m], heap [bytes]
};

/// All that a report tells of.
struct Report {
    FlownRuns flown;
    Summary summary;
    std::optional<LatencyProfile> profile;
    std::vector<MemoryCurve> memory;
    std::vector<OverheadView> worst;
    std::vector<std::string> worst_missing;  ///< which cannot be shown, and why
};

/// One page that needs nothing else: tables and words as HTML, charts by script.
std::string reportPage(const Report& report);

/// The verdict and the main tables, for documents.
std::string reportMarkdown(const Report& report);

}  // namespace hagen
