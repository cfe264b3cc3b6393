#include "Reports.h"

#include <hagen/base/Folder.h>
#include <hagen/base/NumberText.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <limits>
#include <string>

namespace {

using hagen::logs::Conversion;
using hagen::logs::ConversionReport;

std::string counted(std::size_t number, const std::string& one, const std::string& many) {
    return std::to_string(number) + " " + (number == 1 ? one : many);
}

/// Bytes of a file or of all files in a folder; without those that another program takes away
/// meanwhile.
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

/// "12.3 MB".
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
    const std::size_t last = report.left_out_before + report.entries - 1;
    // A recording that ends before --to has no entries behind it.
    const bool is_cut = report.left_out_before > 0 || last == conversion.to;
    std::printf("%s in %s%s, %zu returns:\n",
                counted(report.scans, "LiDAR scan", "LiDAR scans").c_str(),
                counted(report.entries, "entry", "entries").c_str(),
                is_cut ? (" (" + std::to_string(report.left_out_before) + " to " +
                          std::to_string(last) + " of the input; others are skipped)")
                             .c_str()
                       : "",
                report.returns);
}

/// Why some scans have no attitude; empty if all have one.
std::string whyNotAll(const ConversionReport& report) {
    if (report.first_without_attitude.empty()) return "";
    const std::size_t others = report.scans - report.scans_with_attitude - 1;
    return " (not " + report.first_without_attitude +
           (others > 0 ? " and " + std::to_string(others) + " more" : "") +
           (report.is_attitude_of_poses
                ? ": before or after the poses, or in a gap of more than 0.2 s between them)"
                : ": the log has no attitude in the 0.2 s before)");
}

}  // namespace

void printSummary(const Conversion& conversion, const ConversionReport& report) {
    printEntries(conversion, report);
    const auto line = [&](std::size_t part, const std::string& what) {
        const double share = report.returns == 0 ? 0.0
                                                 : 100.0 * static_cast<double>(part) /
                                                       static_cast<double>(report.returns);
        std::printf("  %9zu  %5.1f %%  %s\n", part, share, what.c_str());
    };
    char zone[32];
    std::snprintf(zone, sizeof zone, "%g", static_cast<double>(report.settings.options.zone_m));
    line(report.roi, "region of interest: near obstacles");
    line(report.rou, std::string("region of uninterest: ground, or farther than ") + zone + " m");
    line(report.unclassified, "unclassified: no range, or the vehicle's own airframe");
    if (report.returns_masked > 0) {
        line(report.returns_masked, "  of these: the airframe, masked as the settings say");
    }
    if (report.unreadable_scans > 0) {
        std::printf("%s could not be read, kept unchanged\n",
                    counted(report.unreadable_scans, "scan", "scans").c_str());
    }
    if (report.results_replaced > 0) {
        std::printf("%s of an earlier run replaced\n",
                    counted(report.results_replaced, "result", "results").c_str());
    }
    for (const auto& [label, sensor] : report.sensors) {
        std::cout << "sensor " << label << ": " << sensor
                  << "\n";  // from the log: keepTerminalSafe()
    }
    if (!report.poses.empty()) {
        std::printf("poses of %zu of %s: %s\n", report.scans_with_pose,
                    counted(report.scans, "scan", "scans").c_str(), report.poses.c_str());
    }
    if (!conversion.octomaps.empty()) {
        std::printf("in the OctoMap: %zu of %s\n", report.scans_in_map,
                    counted(report.scans, "scan", "scans").c_str());
    }
    if (report.scans_with_attitude > 0 && report.settings.options.level_by_attitude) {
        std::printf("gravity-aligned by the vehicle's attitude: %zu of %s%s\n",
                    report.scans_with_attitude, counted(report.scans, "scan", "scans").c_str(),
                    whyNotAll(report).c_str());
    }
    const auto output = [](const char* what, const std::filesystem::path& path) {
        if (path.empty()) return;
        std::printf("%s: %s (%s)\n", what, path.c_str(), sizeText(path).c_str());
    };
    output("segmented rawlog", conversion.rawlog);
    if (report.scans > 0) {  // otherwise there are no folders
        output("scans and labels", conversion.folder);
        output("pictures", conversion.pictures);
    }
    if (report.clouds > 0) {
        std::printf("labelled clouds: %s (%s, %s, %zu points)\n", conversion.clouds.c_str(),
                    sizeText(conversion.clouds).c_str(),
                    counted(report.clouds, "file", "files").c_str(), report.cloud_points);
    }
    if (report.mcap.scans > 0) {
        std::printf("MCAP: %s (%s, %zu points, %s, %zu messages)\n", conversion.mcap.c_str(),
                    counted(report.mcap.scans, "scan", "scans").c_str(), report.mcap.points,
                    counted(report.mcap.boxes, "box", "boxes").c_str(), report.mcap.messages);
    }
    for (const auto& octomap : conversion.octomaps) output("OctoMap", octomap);
    output("statistics", conversion.stats);
}

void printAirframe(const hagen::logs::AirframeLearning& learning,
                   const hagen::logs::AirframeReport& report) {
    std::printf("%s of '%s':\n", counted(report.scans, "LiDAR scan", "LiDAR scans").c_str(),
                report.sensor_label.c_str());
    std::printf("  %s masked: %.2f %% of the sphere, %.2f %% of the directions with returns\n",
                counted(static_cast<std::size_t>(report.bins), "bin", "bins").c_str(),
                100 * report.share_of_sphere, 100 * report.share_of_seen);
    if (report.unreadable_scans > 0) {
        std::printf("%s could not be read and left out\n",
                    counted(report.unreadable_scans, "scan", "scans").c_str());
    }
    std::printf("airframe: %s\npicture: %s\n", learning.file.c_str(), report.picture.c_str());
    std::fflush(stdout);
    const char* const input = learning.input.c_str();
    if (report.bins == 0) {
        std::fprintf(stderr, "%s: nothing near the sensor stays at its place: no mask is needed\n",
                     input);
    }
    if (report.isSuspicious()) {
        std::fprintf(stderr,
                     "%s: WARNING: more than 20 %% is masked. A wall beside a standing vehicle "
                     "looks like this: fly or turn, or skip the time on the ground with --from. "
                     "Look at %s before you use it\n",
                     input, report.picture.c_str());
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
            std::printf("| %s%s ", row[i].c_str(),
                        std::string(widths[i] - row[i].size(), fill).c_str());
        }
        std::printf("|\n");
    };
    print(rows[0], ' ');
    print({}, '-');
    for (std::size_t i = 1; i < rows.size(); ++i) print(rows[i], ' ');
}
