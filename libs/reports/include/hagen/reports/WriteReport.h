#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hagen::reports {

/// What to report on, and where.
struct ReportRequest {
    std::filesystem::path folder;    ///< of a campaign, finished or not
    std::filesystem::path memory;    ///< heap curves; empty: folder/memory.csv where there is one
    std::filesystem::path markdown;  ///< main tables; empty: not written
    std::size_t worst = 6;           ///< worst runs to fly again for a view from above
    bool overwrite = false;          ///< replace outputs that exist
    /// Told of each run before it is flown again.
    std::function<void(const std::string& what)> doing = [](const auto&) {};
};

/// Writes report.html, summary.json and summary.csv into the folder, and the Markdown. Returns the
/// verdict as lines to print, the page's path last. Throws std::runtime_error, naming the file,
/// for what cannot be read or written, and where no run is finished.
std::vector<std::string> writeReport(const ReportRequest& request);

}  // namespace hagen::reports
