// Segments a log: regions of interest (near obstacles) and the rest of each LiDAR scan.
#include <hagen/logs/Conversion.h>
#include <hagen/logs/ScanFolder.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "Progress.h"
#include "Reports.h"
#include "common/Interrupt.h"

namespace {

using namespace hagen;

constexpr int kFailed = 1, kWrongUsage = 2;

logs::ConversionReport convertAloud(const logs::Conversion& conversion, bool quiet) {
    Progress progress(conversion.input.string(), quiet);
    logs::ConversionListener listener = progress.listener();
    listener.keep_going = [] { return !isInterrupted(); };
    logs::ConversionReport report;
    try {
        report = logs::convert(conversion, listener);
    } catch (...) {
        progress.finish();
        throw;
    }
    progress.finish();
    if (!quiet && report.scans == 0) {
        std::cerr << conversion.input.string()
                  << ": no LiDAR scan was segmented; scans are CObservationVelodyneScan or "
                     "CObservationPointCloud\n";
    }
    if (!quiet && !conversion.poses.empty() && report.poses.empty()) {
        std::cerr << conversion.poses.string()
                  << ": is not used: only a window (window_scans), --kitti and --octomap need it; "
                     "angles are "
                     "levelled by poses with times (TUM) alone\n";
    }
    return report;
}

/// The settings in force, with a scan folder's own.
void printSettings(const logs::Conversion& conversion) {
    observations::Settings settings = conversion.settings;
    if (std::filesystem::is_directory(conversion.input)) {
        const logs::ScanFolder folder(conversion.input);
        if (std::filesystem::exists(folder.sensorFile())) {
            observations::mergeSettings(folder.sensorFile(), settings);
        }
    }
    std::cout << observations::dumpSettings(settings);
}

int fail(int exit_code, const std::string& message) {
    std::cerr << "rawlog-segment: " << message << "\n";
    return exit_code;
}

/// What the command line says.
struct CommandLine {
    logs::Conversion conversion;
    std::vector<std::string> configs;
    bool is_quiet = false, dumps_settings = false;
};

/// Reads a name as what it stands for. CLI11's own tells the numbers behind the names, too.
template <class Value>
CLI::Validator oneOf(const std::vector<std::pair<std::string, Value>>& values) {
    return CLI::Validator(
        [values](std::string& name) -> std::string {
            std::string names;
            for (const auto& [known, value] : values) {
                if (name == known) {
                    name = std::to_string(static_cast<int>(value));
                    return "";
                }
                names += (names.empty() ? "" : ", ") + known;
            }
            return "'" + name + "' is none of " + names;
        },
        "");
}

void declare(CLI::App& app, CommandLine& line) {
    logs::Conversion& conversion = line.conversion;
    const CLI::Validator not_empty(
        [](const std::string& name) { return name.empty() ? "the name is empty" : ""; }, "PATH");

    app.add_option("-i,--input", conversion.input, "a .rawlog, or a scan folder (KITTI layout)")
        ->check(CLI::ExistingPath)
        ->group("Input");
    app.add_option("--from", conversion.from,
                   "first entry to convert, counted from 0; of a scan "
                   "folder: scan")
        ->check(CLI::NonNegativeNumber)
        ->group("Input");
    app.add_option("--to", conversion.to, "last entry to convert")
        ->check(CLI::NonNegativeNumber)
        ->group("Input");
    app.add_option("--sensor-label", conversion.sensor_labels,
                   "segment this LiDAR alone; may be repeated")
        ->allow_extra_args(false)
        ->group("Input");
    app.add_option("--poses", conversion.poses,
                   "where the vehicle was (TUM), or the sensor scan by scan (KITTI); wins over the "
                   "log's own")
        ->check(CLI::ExistingFile)
        ->group("Input");

    auto* rawlog = app.add_option("-o,--output", conversion.rawlog,
                                  "segmented rawlog: all entries, and two clouds a scan")
                       ->check(not_empty)
                       ->group("Output");
    app.add_flag("--preview", conversion.preview,
                 "add a scene to each scan, which RawLogViewer shows in colour")
        ->needs(rawlog)
        ->group("Output");
    app.add_option("--cloud", conversion.cloud_class,
                   "clouds of coordinates (simple), or with "
                   "intensities (xyzi)")
        ->transform(
            oneOf<observations::CloudClass>({{"simple", observations::CloudClass::Simple},
                                             {"xyzi", observations::CloudClass::WithIntensity}}))
        ->option_text("simple|xyzi")
        ->needs(rawlog)
        ->group("Output");
    app.add_option("--kitti", conversion.folder,
                   "scan folder: velodyne/*.bin, labels/*.label; of several LiDARs one each in it")
        ->check(not_empty)
        ->group("Output");
    auto* pictures = app.add_option("--pictures", conversion.pictures,
                                    "folder of PNGs, a folder a scan: what each stage made of it")
                         ->check(not_empty)
                         ->group("Output");
    app.add_option("--picture-azimuth", conversion.picture_azimuth_deg,
                   "column whose principal components are drawn: degrees to the left of ahead "
                   "(default: that of the nearest obstacle)")
        ->check(CLI::Range(-360.0, 360.0))
        ->needs(pictures)
        ->group("Output");
    auto* octomap =
        app.add_option("--octomap", conversion.octomaps,
                       "OctoMap of the scans, which need poses: .bt, .ot, or .3Dscene for "
                       "SceneViewer3D; may be repeated")
            ->allow_extra_args(false)
            ->check(CLI::Validator(
                [](const std::string& name) {
                    return mapping::isMapFile(name)
                               ? ""
                               : name + " does not end in .bt, .ot or .3Dscene";
                },
                "PATH"))
            ->group("Output");
    app.add_option("--octomap-content", conversion.octomap.content,
                   "every return (full), RoI returns alone (roi), or RoI returns, and free space "
                   "from all rays (roi+rays, the default)")
        ->transform(oneOf<mapping::MapContent>({{"full", mapping::MapContent::Full},
                                                {"roi", mapping::MapContent::Roi},
                                                {"roi+rays", mapping::MapContent::RoiAndRays}}))
        ->option_text("full|roi|roi+rays")
        ->needs(octomap)
        ->group("Output");
    app.add_option("--octomap-resolution", conversion.octomap.resolution_m,
                   "edge of its voxels in metres (default: 0.2)")
        ->check(CLI::Range(0.01, 100.0))
        ->option_text("M")
        ->needs(octomap)
        ->group("Output");
    app.add_option("--stats", conversion.stats, "JSON: settings, counts, latencies, each scan")
        ->check(not_empty)
        ->group("Output");
    app.add_flag("--overwrite", conversion.overwrite, "replace outputs that exist")
        ->group("Output");
    app.add_option("--jobs", conversion.jobs,
                   "threads (default: as many as there are cores); results do not depend on it")
        ->check(CLI::Range(1, 1024))
        ->option_text("N")
        ->group("Output");
    app.add_flag("-q,--quiet", line.is_quiet, "print errors only")->group("Output");

    app.add_option("-c,--config", line.configs, "settings file; may be repeated, later ones win")
        ->allow_extra_args(false)
        ->group("Settings");
    app.add_flag("--config-dump", line.dumps_settings, "print the settings in force, and stop")
        ->group("Settings");
    app.add_flag_callback(
           "--config-keys",
           [] {
               printSettingsKeys();
               throw CLI::Success();
           },
           "print the table of all settings, and stop")
        ->group("Settings");
    app.set_version_flag("--version", "rawlog-segment " HAGEN_VERSION);
}

/// What one flag alone cannot tell.
void check(const CommandLine& line) {
    const logs::Conversion& conversion = line.conversion;
    if (line.dumps_settings) return;
    if (conversion.input.empty()) throw CLI::RequiredError("--input");
    if (conversion.rawlog.empty() && conversion.folder.empty() && conversion.pictures.empty() &&
        conversion.octomaps.empty() && conversion.stats.empty()) {
        throw CLI::RequiredError("an output (-o, --kitti, --pictures, --octomap or --stats)");
    }
    if (!(conversion.octomap.resolution_m > 0)) {  // not a number is in any range
        throw CLI::ValidationError("--octomap-resolution", "is not more than 0");
    }
    if (conversion.from > conversion.to) {
        throw CLI::ValidationError("--from", "is beyond --to");
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Examples:\n"
        "  rawlog-segment -i flight.rawlog -o segmented.rawlog\n"
        "  rawlog-segment -i flight.rawlog -o segmented.rawlog --preview --stats flight.json\n"
        "  rawlog-segment -i flight.rawlog --kitti labels -c config/paper.yaml\n"
        "  rawlog-segment -i flight.rawlog --pictures pictures --from 100 --to 110\n"
        "  rawlog-segment -i flight.rawlog --octomap map.bt --poses flight.tum\n"
        "  rawlog-segment -i scan_folder --kitti labels -c config/hdl64e.yaml\n"
        "\n"
        "Separates near obstacles (RoI) from ground and far returns (ROU) in the LiDAR scans of a "
        "log."};
    app.footer("Exit codes: 0 done, 1 failed while running, 2 wrong usage.");
    CommandLine line;
    declare(app, line);
    try {
        app.parse(argc, argv);
        check(line);
        for (const std::string& config : line.configs) {
            observations::mergeSettings(config, line.conversion.settings);
        }
        if (line.dumps_settings) {
            printSettings(line.conversion);
        } else {
            catchSignals();
            const logs::ConversionReport report = convertAloud(line.conversion, line.is_quiet);
            if (!line.is_quiet) printSummary(line.conversion, report);
            if (report.scans == 0 && report.unreadable_scans > 0) {
                return fail(kFailed, "none of the LiDAR scans could be read");
            }
        }
        if (std::fflush(stdout) != 0 || !std::cout.flush()) {
            return fail(kFailed, "the summary cannot be printed");
        }
        return 0;
    } catch (const CLI::Success& e) {  // --help, --version
        app.exit(e);
        const bool is_printed = std::fflush(stdout) == 0 && std::cout.flush();
        return is_printed ? 0 : fail(kFailed, "the text cannot be printed");
    } catch (const CLI::ParseError& e) {
        app.exit(e);
        return kWrongUsage;
    } catch (const observations::SettingsError& e) {
        return fail(kWrongUsage, e.what());
    } catch (const std::filesystem::filesystem_error& e) {
        return fail(kFailed, e.path1().string() + ": " + e.code().message());
    } catch (const std::exception& e) {
        return fail(kFailed, e.what());
    }
}
