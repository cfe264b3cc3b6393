#include "Reports.h"

#include "base/Folder.h"
#include "base/NumberText.h"
#include "base/Quantile.h"
#include "base/command_line/Terminal.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

// Labels, frames and names are untrusted: print them to std::cout, which keepTerminalSafe() guards,
// never with printf().
namespace {

using hagen::base::counted;
using hagen::convert::Conversion;
using hagen::convert::ConversionReport;

/// Size of a file or of all files in a folder, in bytes. Ignores files removed concurrently.
double bytesOf(const std::filesystem::path& path) {
    namespace fs = std::filesystem;
    std::error_code unreadable;
    if (fs::is_directory(path, unreadable)) {
        double bytes = 0;
        for (const fs::path& entry : hagen::base::entriesOf(path, unreadable)) {
            if (!fs::is_symlink(entry, unreadable)) bytes += bytesOf(entry);
        }
        return bytes;
    }
    const std::uintmax_t bytes = fs::file_size(path, unreadable);
    return unreadable ? 0 : static_cast<double>(bytes);
}

/// The size of a file or folder, such as "12.3 MB".
std::string sizeText(const std::filesystem::path& path) {
    const char* unit = "kB";
    double size = bytesOf(path) / 1e3;
    for (const char* larger : {"MB", "GB"}) {
        if (size < 1000) break;
        size /= 1e3;
        unit = larger;
    }
    return hagen::base::fixedText(size, 1) + " " + unit;
}

void printEntries(const Conversion& conversion, const ConversionReport& report) {
    std::cout << counted(report.scans, "LiDAR scan") << " in "
              << counted(report.entries, "entry", "entries");
    // If the recording ends before --to, no later scans were skipped.
    const auto& scans = report.scan_reports;
    if (!scans.empty() &&
        (conversion.source.first_scan > 0 || scans.back().entry == conversion.source.last_scan)) {
        std::cout << " (scans " << scans.front().entry << " to " << scans.back().entry
                  << " of the input; the rest was skipped)";
    }
    std::cout << ", " << report.returns << " returns:\n";
}

/// Why some scans have no attitude; empty if all scans have one.
std::string whyNotAll(const ConversionReport& report) {
    if (report.first_without_attitude.empty()) return "";
    const std::size_t others = report.scans - report.scans_with_attitude - 1;
    return " (not " + report.first_without_attitude +
           (others > 0 ? " and " + std::to_string(others) + " more" : "") +
           (report.is_attitude_of_poses
                ? ": before or after the poses, or in a gap of more than 0.2 s between them)"
                : ": the log has no attitude in the preceding 0.2 s)");
}

constexpr float kMaxAirframe_m = 1;

/// The nearest obstacle, and medians over the scans.
void printObstacles(const ConversionReport& report) {
    const std::vector<hagen::convert::ScanReport>& scans = report.scan_reports;
    if (scans.empty()) return;
    const auto distance_m = [](const hagen::convert::ScanReport& scan) {
        return scan.obstacles > 0 ? scan.nearest_roi_m : std::numeric_limits<float>::infinity();
    };
    const auto nearest = std::min_element(
        scans.begin(), scans.end(),
        [&](const auto& a, const auto& b) { return distance_m(a) < distance_m(b); });
    std::vector<double> obstacles, latencies_ms;
    for (const auto& scan : scans) {
        obstacles.push_back(static_cast<double>(scan.obstacles));
        latencies_ms.push_back(scan.latency_ms);
    }
    using hagen::base::fixedText;
    if (nearest->obstacles > 0) {
        std::cout << "nearest obstacle: " << fixedText(distance_m(*nearest), 2) << " m, "
                  << fixedText(nearest->time_s - scans.front().time_s, 1)
                  << " s after the first scan (scan " << nearest->entry << ")"
                  << (distance_m(*nearest) < kMaxAirframe_m && report.returns_masked == 0
                          ? "; the vehicle itself? See --learn-airframe"
                          : "")
                  << "\n";
    }
    std::cout << "groups of obstacle returns per scan: "
              << fixedText(hagen::base::quantile(obstacles, 0.5), 0) << " (median); time per scan: "
              << fixedText(hagen::base::quantile(latencies_ms, 0.5), 2) << " ms (median)\n";
    if (report.scans_without_ground > 0) {
        std::cout << "no ground found: " << report.scans_without_ground << " of "
                  << counted(report.scans, "scan") << "\n";
    }
}

}  // namespace

void printSummary(const Conversion& conversion, const ConversionReport& report) {
    printEntries(conversion, report);
    const auto line = [&](std::size_t part, const std::string& what) {
        const double share = report.returns == 0 ? 0.0
                                                 : 100.0 * static_cast<double>(part) /
                                                       static_cast<double>(report.returns);
        std::cout << "  " << std::setw(9) << part << "  " << std::setw(5)
                  << hagen::base::fixedText(share, 1) << " %  " << what << "\n";
    };
    char zone[32];
    std::snprintf(zone, sizeof zone, "%g", static_cast<double>(report.settings.options.zone_m));
    line(report.roi, "region of interest: near obstacles");
    line(report.rou, std::string("region of uninterest: ground, or farther than ") + zone + " m");
    line(report.unclassified, "unclassified: no range, or the vehicle's own airframe");
    if (report.returns_masked > 0) {
        line(report.returns_masked, "  of these: the settings' airframe, masked");
    }
    printObstacles(report);
    if (report.unreadable_scans > 0) {
        std::cout << counted(report.unreadable_scans, "scan") << " unreadable, kept unchanged\n";
    }
    if (report.results_replaced > 0) {
        std::cout << counted(report.results_replaced, "result") << " of an earlier run replaced\n";
    }
    for (const auto& [label, sensor] : report.sensors) {
        std::cout << hagen::base::oneLine("sensor " + label + ": " + sensor) << "\n";
    }
    if (!report.poses.empty()) {
        std::cout << "poses of " << report.scans_with_pose << " of "
                  << counted(report.scans, "scan") << ": " << report.poses << "\n";
    }
    if (!conversion.octomaps.empty()) {
        std::cout << "in the OctoMap: " << report.scans_in_map << " of "
                  << counted(report.scans, "scan") << "\n";
    }
    if (report.scans_with_attitude > 0 && report.settings.options.level_by_attitude) {
        std::cout << "gravity-aligned by the vehicle's attitude: " << report.scans_with_attitude
                  << " of " << counted(report.scans, "scan") << whyNotAll(report) << "\n";
    }
    const auto output = [](const char* what, const std::filesystem::path& path) {
        if (path.empty()) return;
        std::cout << what << ": " << path.string() << " (" << sizeText(path) << ")\n";
    };
    output("segmented rawlog", conversion.rawlog);
    if (report.scans > 0) {  // otherwise there are no folders to list
        output("scans and labels", conversion.folder);
        output("pictures", conversion.pictures);
    }
    if (report.clouds > 0) {
        std::cout << "labelled clouds: " << conversion.clouds.string() << " ("
                  << sizeText(conversion.clouds) << ", " << counted(report.clouds, "file") << ", "
                  << report.cloud_points << " points)\n";
    }
    if (report.view_frames > 0) {
        std::cout << "view: " << conversion.view.string() << " ("
                  << counted(report.view_frames, "scan", "scans")
                  << (report.view_every > 1 ? ", 1 of " + std::to_string(report.view_every) : "")
                  << ", " << sizeText(conversion.view) << "); open it in a browser\n";
    }
    if (report.mcap.scans > 0) {
        std::cout << "MCAP: " << conversion.mcap.string() << " ("
                  << counted(report.mcap.scans, "scan") << ", " << report.mcap.points << " points, "
                  << counted(report.mcap.boxes, "box", "boxes") << ", " << report.mcap.messages
                  << " messages)\n";
    }
    for (const auto& octomap : conversion.octomaps) output("OctoMap", octomap);
    output("statistics", conversion.stats);
}

void printAirframe(const hagen::convert::AirframeLearning& learning,
                   const hagen::convert::AirframeReport& report) {
    const auto percent = [](double share) { return hagen::base::fixedText(100 * share, 2) + " %"; };
    std::cout << counted(report.scans, "LiDAR scan") << " of '"
              << hagen::base::oneLine(report.sensor_label) << "':\n  "
              << counted(static_cast<std::size_t>(report.bins), "bin")
              << " masked: " << percent(report.share_of_sphere) << " of the sphere, "
              << percent(report.share_of_seen) << " of the directions with returns\n";
    if (report.unreadable_scans > 0) {
        std::cout << counted(report.unreadable_scans, "scan") << " unreadable, skipped\n";
    }
    std::cout << "airframe: " << learning.file.string() << "\npicture: " << report.picture.string()
              << "\nto use it, add a settings file with -c: airframe: [{learned: "
              << learning.file.string() << "}]\n"
              << std::flush;
    const std::string input = learning.input.string();
    if (report.bins == 0) {
        std::cerr << input << ": no fixed object near the sensor; no mask is needed\n";
    }
    if (report.isSuspicious()) {
        std::cerr << input
                  << ": WARNING: more than 20 % is masked, as near a wall while stationary. "
                     "Fly or turn, or skip the time on the ground with --from. Check "
                  << report.picture.string() << " before using the mask\n";
    }
}

void printSettingsKeys() {
    using Row = std::array<std::string, 6>;
    std::vector<Row> rows{{"key", "unit", "default", "range", "meaning", "in the paper"}};
    for (const hagen::SettingsKey& key : hagen::settingsKeys()) {
        rows.push_back({key.name, key.unit, key.standard, key.range, key.what, key.symbol});
    }
    std::array<std::size_t, 6> widths{};
    for (const Row& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            widths[i] = std::max(widths[i], row[i].size());
        }
    }
    const auto print = [&](const Row& row, char fill) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            std::cout << "| " << row[i] << std::string(widths[i] - row[i].size(), fill) << " ";
        }
        std::cout << "|\n";
    };
    print(rows[0], ' ');
    print({}, '-');
    for (std::size_t i = 1; i < rows.size(); ++i) print(rows[i], ' ');
}
