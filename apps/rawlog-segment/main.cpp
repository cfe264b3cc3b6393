// Segments a log: regions of interest (near obstacles) and the rest of each LiDAR scan.
#include <unistd.h>

#include <hagen/observations/Conversion.h>
#include <hagen/segmentation/OptionKeys.h>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace {

using namespace hagen;

constexpr int kFailed = 1, kWrongUsage = 2;
constexpr std::size_t kMostRemarks = 10;  // one a scan would bury everything else

std::string counted(std::size_t number, const std::string& one, const std::string& many) {
    return std::to_string(number) + " " + (number == 1 ? one : many);
}

void printSummary(const Conversion& conversion, const ConversionReport& report) {
    std::printf("%s in %s, %zu returns:\n",
                counted(report.scans, "LiDAR scan", "LiDAR scans").c_str(),
                counted(report.entries, "entry", "entries").c_str(), report.returns);
    const auto line = [&](std::size_t part, const std::string& what) {
        const double share = report.returns == 0 ? 0.0
                                                 : 100.0 * static_cast<double>(part) /
                                                       static_cast<double>(report.returns);
        std::printf("  %9zu  %5.1f %%  %s\n", part, share, what.c_str());
    };
    char zone[32];
    std::snprintf(zone, sizeof zone, "%g", static_cast<double>(conversion.settings.options.zone_m));
    line(report.roi, "region of interest: near obstacles");
    line(report.rou, std::string("region of uninterest: ground, or farther than ") + zone + " m");
    line(report.unclassified, "unclassified: out of the sensor's range");
    if (report.unreadable_scans > 0) {
        std::printf("%s could not be read, kept as before\n",
                    counted(report.unreadable_scans, "scan", "scans").c_str());
    }
    for (const auto& [label, sensor] : report.sensors) {
        std::printf("sensor %s: %s\n", label.c_str(), sensor.c_str());
    }
    if (!conversion.rawlog.empty()) {
        std::printf("segmented rawlog: %s\n", conversion.rawlog.c_str());
    }
    if (!conversion.folder.empty()) {
        std::printf("scans and labels: %s\n", conversion.folder.c_str());
    }
}

/// Converts, with remarks and progress on standard error. A remark is printed where it first comes
/// up, and counted from then on.
ConversionReport convertAloud(const Conversion& conversion, bool quiet) {
    const bool on_terminal = !quiet && isatty(STDERR_FILENO) != 0;
    const char* const clear_line = on_terminal ? "\r\033[K" : "";
    const std::string input = conversion.input.string();
    const auto tell = [&](const std::string& entry, const std::string& what) {
        std::cerr << clear_line << input << ": " << entry << ": " << what << "\n";
    };
    std::map<std::string, std::size_t> remarks;
    std::size_t untold = 0;
    ConversionListener listener;
    listener.unreadable = [&](const std::string& entry, const std::string& why) {
        tell(entry, "kept, but not segmented: " + why);
    };
    listener.remark = [&](const std::string& entry, const std::string& remark) {
        if (quiet || remarks[remark]++ > 0) return;
        if (remarks.size() > kMostRemarks) {
            ++untold;
        } else {
            tell(entry, remark);
        }
    };
    if (on_terminal) {
        listener.progress = [&](const ConversionReport& report) {
            std::cerr << "\r" << report.entries << " entries, " << report.scans << " scans"
                      << std::flush;
        };
    }
    const ConversionReport report = convert(conversion, listener);
    std::cerr << clear_line;
    for (const auto& [remark, times] : remarks) {
        if (times < 2) continue;
        std::cerr << input << ": the same of " << times - 1 << " more: " << remark << "\n";
    }
    if (untold > 0) std::cerr << input << ": and " << untold << " remarks more\n";
    if (!quiet && report.scans == 0) {
        std::cerr << input
                  << ": no LiDAR scan was segmented; scans are CObservationVelodyneScan or "
                     "CObservationPointCloud\n";
    }
    return report;
}

/// The table of settings: key, default, range and unit, meaning.
void printConfigKeys() {
    std::printf("%-20s %-8s %-24s %s\n", "key", "default", "range", "meaning");
    for (const OptionKey& key : optionKeys()) {
        const double value =
            std::visit([](auto field) { return static_cast<double>(Options().*field); }, key.field);
        char standard[32], range[64];
        std::snprintf(standard, sizeof standard, "%g", value);
        std::snprintf(range, sizeof range, "%g ... %g %s", key.least, key.most, key.unit.c_str());
        const bool is_word = std::holds_alternative<Seeds Options::*>(key.field);
        std::printf("%-20s %-8s %-24s %s%s\n", key.name.c_str(), is_word ? "lowest" : standard,
                    is_word ? "lowest, top_and_nearest" : range, key.what.c_str(),
                    key.symbol.empty() ? "" : (" (the paper's " + key.symbol + ")").c_str());
    }
    std::printf(
        "sensor: {model, elevations_deg, min_range_m, max_range_m}; include: FILE or a list\n");
}

int fail(int exit_code, const std::string& message) {
    std::cerr << "rawlog-segment: " << message << "\n";
    return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Separate near obstacles (RoI) from ground and far returns (ROU) in the LiDAR scans of a "
        "log."};
    app.footer(
        "Examples:\n"
        "  rawlog-segment -i flight.rawlog -o segmented.rawlog\n"
        "  rawlog-segment -i flight.rawlog --kitti labels -c config/paper.yaml\n"
        "  rawlog-segment -i scan_folder --kitti labels -c config/hdl64e.yaml\n"
        "Exit codes: 0 done, 1 failed while running, 2 wrong usage.");
    Conversion conversion;
    std::vector<std::string> configs;
    bool quiet = false;
    const CLI::Validator not_empty(
        [](const std::string& name) { return name.empty() ? "the name is empty" : ""; }, "PATH");
    app.add_flag_callback(
        "--config-keys",
        [] {
            printConfigKeys();
            throw CLI::Success();
        },
        "list the keys of settings files, and stop");
    app.set_version_flag("--version", "rawlog-segment " HAGEN_VERSION);
    app.add_option("-i,--input", conversion.input, "a .rawlog, or a scan folder (KITTI layout)")
        ->required()
        ->check(CLI::ExistingPath);
    auto* rawlog = app.add_option("-o,--output", conversion.rawlog,
                                  "segmented rawlog: all entries, and two clouds a scan")
                       ->check(not_empty);
    auto* folder = app.add_option("--kitti", conversion.folder,
                                  "scan folder to write: velodyne/*.bin, labels/*.label")
                       ->check(not_empty);
    app.add_option("-c,--config", configs, "settings file; may be repeated, later ones win");
    app.add_flag("--overwrite", conversion.overwrite, "replace outputs that exist");
    app.add_flag("-q,--quiet", quiet, "print errors only");
    try {
        app.parse(argc, argv);
        if (rawlog->count() == 0 && folder->count() == 0) {
            throw CLI::RequiredError("an output (-o or --kitti)");
        }
        for (const std::string& config : configs) mergeSettings(config, conversion.settings);
        const ConversionReport report = convertAloud(conversion, quiet);
        if (!quiet) printSummary(conversion, report);
        if (report.scans == 0 && report.unreadable_scans > 0) {
            return fail(kFailed, "none of the LiDAR scans could be read");
        }
        if (std::fflush(stdout) != 0) return fail(kFailed, "the summary cannot be printed");
        return 0;
    } catch (const CLI::Success& e) {  // --help, --version
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        app.exit(e);
        return kWrongUsage;
    } catch (const SettingsError& e) {
        return fail(kWrongUsage, e.what());
    } catch (const std::filesystem::filesystem_error& e) {
        return fail(kFailed, e.path1().string() + ": " + e.code().message());
    } catch (const std::exception& e) {
        return fail(kFailed, e.what());
    }
}
