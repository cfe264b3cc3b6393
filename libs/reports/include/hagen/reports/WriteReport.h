#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hagen::reports {

/// Inputs and outputs of a report.
struct ReportRequest {
    std::filesystem::path folder;    ///< of a campaign, finished or not
    std::filesystem::path memory;    ///< heap curves; empty: folder/memory.csv if it exists
    std::filesystem::path markdown;  ///< file for the main tables; empty: not written
    std::size_t worst = 6;           ///< number of worst runs to fly again for views from above
    bool overwrite = false;          ///< replace existing outputs
    /// Called before each run that is flown again.
    std::function<void(const std::string& what)> doing = [](const auto&) {};
    /// Called before each such run, and before anything is written. What it throws ends the report.
    std::function<void()> continuing = [] {};
};

/// Writes report.html, summary.json and summary.csv into the folder, and the Markdown. Returns the
/// verdict as lines to print, the page's path last. Throws std::runtime_error, naming the file, if
/// one cannot be read or written, or if no run is finished.
std::vector<std::string> writeReport(const ReportRequest& request);

}  // namespace hagen::reports
