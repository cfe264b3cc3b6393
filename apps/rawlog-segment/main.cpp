// Segments a log: regions of interest (near obstacles) and the rest of each LiDAR scan.
#include <unistd.h>

#include <hagen/observations/Conversion.h>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace hagen;

constexpr int kFailed = 1, kWrongUsage = 2;
constexpr std::size_t kMostRemarks = 10;  // one remark a scan would bury everything else

void printSummary(const Conversion& conversion, const ConversionReport& report) {
    const auto percent = [&](std::size_t part) {
        return report.returns == 0
                   ? 0.0
                   : 100.0 * static_cast<double>(part) / static_cast<double>(report.returns);
    };
    std::printf("%zu LiDAR scans in %zu entries, %zu returns:\n", report.scans, report.entries,
                report.returns);
    std::printf("  %9zu  %5.1f %%  region of interest: near obstacles\n", report.roi,
                percent(report.roi));
    std::printf("  %9zu  %5.1f %%  region of uninterest: ground, farther than %g m\n", report.rou,
                percent(report.rou), static_cast<double>(conversion.settings.options.zone_m));
    std::printf("  %9zu  %5.1f %%  unclassified: out of the sensor's range\n", report.unclassified,
                percent(report.unclassified));
    if (report.unreadable_scans > 0) {
        std::printf("  %zu scans could not be read and were kept as they are\n",
                    report.unreadable_scans);
    }
    if (!conversion.rawlog.empty()) {
        std::printf("segmented rawlog: %s\n", conversion.rawlog.c_str());
    }
    if (!conversion.folder.empty()) {
        std::printf("scans and labels: %s\n", conversion.folder.c_str());
    }
}

ConversionReport convertAloud(const Conversion& conversion, bool quiet) {
    const bool on_terminal = !quiet && isatty(STDERR_FILENO) != 0;
    const char* const clear_line = on_terminal ? "\r\033[K" : "";
    std::size_t remarks = 0;
    ConversionListener listener;
    listener.remark = [&](const std::string& entry, const std::string& remark) {
        if (quiet || ++remarks > kMostRemarks) return;
        std::cerr << clear_line << conversion.input.string() << ": " << entry << ": " << remark
                  << "\n";
    };
    if (on_terminal) {
        listener.progress = [&](const ConversionReport& report) {
            std::cerr << "\r" << report.entries << " entries, " << report.scans << " scans"
                      << std::flush;
        };
    }
    const ConversionReport report = convert(conversion, listener);
    std::cerr << clear_line;
    if (remarks > kMostRemarks) {
        std::cerr << conversion.input.string() << ": ... and " << remarks - kMostRemarks
                  << " more remarks like these\n";
    }
    if (!quiet && report.scans == 0) {
        std::cerr << conversion.input.string()
                  << ": no LiDAR scan was segmented; scans are CObservationVelodyneScan or "
                     "CObservationPointCloud\n";
    }
    return report;
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
        "  rawlog-segment -i scan_folder --kitti labels -c config/hdl64e.yaml");
    Conversion conversion;
    std::vector<std::string> configs;
    bool quiet = false;
    app.add_option("-i,--input", conversion.input, "a .rawlog, or a scan folder (KITTI layout)")
        ->required()
        ->check(CLI::ExistingPath);
    auto* rawlog = app.add_option("-o,--output", conversion.rawlog,
                                  "segmented rawlog: all entries, and two clouds a scan");
    auto* folder = app.add_option("--kitti", conversion.folder,
                                  "scan folder to write: velodyne/*.bin, labels/*.label");
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
        return 0;
    } catch (const CLI::CallForHelp& e) {
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        app.exit(e);
        return kWrongUsage;
    } catch (const SettingsError& e) {
        std::cerr << "rawlog-segment: " << e.what() << "\n";
        return kWrongUsage;
    } catch (const std::exception& e) {
        std::cerr << "rawlog-segment: " << e.what() << "\n";
        return kFailed;
    }
}
