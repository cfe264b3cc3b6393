// Segments the LiDAR scans of a log into near obstacles (RoI) and everything else (ROU).
#include <hagen/convert/Conversion.h>
#include <hagen/recordings/ScanSource.h>
#include <hagen/settings/Presets.h>
#include "convert/LearnAirframe.h"
#include "convert/PacketCapture.h"
#include "recordings/clouds/CloudFile.h"

#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "Progress.h"
#include "Reports.h"
#include "base/NumberText.h"
#include "base/command_line/CommandLine.h"
#include "base/command_line/Interrupt.h"
#include "base/command_line/Terminal.h"

namespace {

using namespace hagen;
using namespace hagen::base;

convert::ConversionReport convertAloud(const convert::Conversion& conversion, bool quiet) {
    Progress progress(conversion.input.string(), quiet);
    convert::ConversionListener listener = progress.listener();
    listener.keep_going = [] { return !isInterrupted(); };
    convert::ConversionReport report;
    try {
        report = convert::convert(conversion, listener);
    } catch (...) {
        progress.finish();
        throw;
    }
    progress.finish();
    if (!quiet && !conversion.poses.empty() && report.poses.empty()) {
        std::cerr << conversion.poses.string()
                  << ": ignored: only --kitti, --mcap and --octomap use poses; angles are "
                     "gravity-aligned only with timed poses (TUM)\n";
    }
    return report;
}

/// Prints the current settings, including those of a scan folder.
void printSettings(const convert::Conversion& conversion) {
    Settings settings = conversion.settings;
    if (std::filesystem::is_directory(conversion.input)) {
        settings = recordings::openRecording(conversion.input)->settingsFor(settings);
    }
    std::cout << dumpSettings(settings);
}

struct Flags {
    convert::Conversion conversion;
    std::vector<std::string> configs, keys;
    std::string bin_fields;
    bool is_quiet = false, dumps_settings = false;
    std::filesystem::path learned_airframe, capture;
    double learn_seconds = convert::AirframeLearning().seconds;
};

void declare(Program& app, Flags& flags) {
    convert::Conversion& conversion = flags.conversion;

    app.option("PATH,-i,--input", conversion.input,
               "a rawlog, a network capture (.pcap, .pcapng, .lvx2), a ROS recording (.bag, .mcap, "
               ".db3 "
               "or its folder), a scan folder (KITTI layout), a point cloud (.pcd, .ply, .las, "
               ".npy, .bin) or a folder of them")
        .existingPath()
        .group("Input");
    app.option("--sensor-json", conversion.source.sensor_json, "Ouster metadata file (JSON)")
        .existingFile()
        .group("Input");
    app.option("--calibration", conversion.source.calibration,
               "HDL-64E calibration file (Velodyne's db.xml)")
        .existingFile()
        .group("Input");
    app.option("--topic", conversion.source.topics,
               "read only this LiDAR topic of a ROS recording; may be repeated")
        .once()
        .group("Input");
    app.option("--bin-fields", flags.bin_fields,
               "float32 numbers per point of .bin files, such as x,y,z,i,r,t: intensity, ring, "
               "time; -: skipped (default: x,y,z,i, with r if detected)")
        .valueName("LIST")
        .group("Input");
    app.option(
           "--from", conversion.source.first_scan,
           "first scan to convert, counted from 0 (a turn of a capture, or an entry with scans of "
           "a rawlog)")
        .group("Input");
    app.option("--to", conversion.source.last_scan, "last scan to convert").group("Input");
    app.option("--sensor-label", conversion.source.sensor_labels,
               "segment only this LiDAR; may be repeated")
        .once()
        .mayBeEmpty()  // because sensor labels may be empty
        .group("Input");
    app.option("--poses", conversion.poses,
               "vehicle trajectory (TUM), or one sensor pose per scan (KITTI); overrides the "
               "log's own")
        .existingFile()
        .group("Input");

    const Flag rawlog = app.option("-o,--output", conversion.rawlog,
                                   "segmented rawlog: all entries, plus two clouds per scan")
                            .extension({".rawlog", ""})
                            .group("Output");
    app.flag("--preview", conversion.preview, "add a coloured scene for RawLogViewer to each scan")
        .needs(rawlog)
        .group("Output");
    app.choice<observations::CloudClass>("--cloud", conversion.cloud_class,
                                         {{"simple", observations::CloudClass::Simple},
                                          {"xyzi", observations::CloudClass::WithIntensity},
                                          {"generic", observations::CloudClass::Generic}},
                                         "clouds with coordinates only (simple), with intensities "
                                         "(xyzi), or with all fields, labels and colours, for MRPT "
                                         "from 2.15 on (generic)")
        .valueName("simple|xyzi|generic")
        .needs(rawlog)
        .group("Output");
    app.option("--kitti", conversion.folder,
               "scan folder: velodyne/*.bin, labels/*.label; one subfolder per LiDAR if there are "
               "several")
        .group("Output");
    const Flag labelled_clouds =
        app.option("--clouds", conversion.clouds,
                   "folder of labelled clouds, one file per scan: all fields of the input, label "
                   "(0, 1 ROU, 2 RoI) and obstacle; one subfolder per LiDAR if the log has several")
            .group("Output");
    app.choice<convert::OutputFormat>(
           "--cloud-format", conversion.cloud_format,
           {{"ply", convert::OutputFormat::Ply}, {"pcd", convert::OutputFormat::Pcd}},
           "format of --clouds, binary (default: ply)")
        .valueName("ply|pcd")
        .needs(labelled_clouds)
        .group("Output");
    app.option("--mcap", conversion.mcap,
               "MCAP for Foxglove and ROS 2: clouds with all fields, label and obstacle, obstacle "
               "boxes, and poses if known")
        .extension({".mcap"})
        .group("Output");
    const Flag pictures =
        app.option("--pictures", conversion.pictures,
                   "folder of PNGs, one subfolder per scan: overview with the "
                   "nearest obstacles, and each stage; requires python3-matplotlib")
            .group("Output");
    app.option("--picture-azimuth", conversion.picture_azimuth_deg,
               "column whose principal components are drawn: degrees left of straight ahead "
               "(default: column of the nearest obstacle)")
        .between(-360.0, 360.0)
        .needs(pictures)
        .group("Output");
    const Flag view = app.option("--view", conversion.view,
                                 "HTML page that plays the scans in a browser, offline: returns, "
                                 "obstacles, ground, stages, statistics")
                          .extension({".html"})
                          .group("Output");
    app.option("--view-every", conversion.view_every,
               "show every Nth scan (default: all, or every 2nd, 4th ... so that the page has at "
               "most 500 scans and 40 MB)")
        .between(1, 1000000)
        .valueName("N")
        .needs(view)
        .group("Output");
    const Flag octomap =
        app.option("--octomap", conversion.octomaps,
                   "OctoMap of the scans (requires poses): .bt, .ot, or .3Dscene for "
                   "SceneViewer3D; may be repeated")
            .once()
            .extension({".bt", ".ot", ".3Dscene"})
            .group("Output");
    app.choice<observations::MapContent>(
           "--octomap-content", conversion.octomap.content,
           {{"full", observations::MapContent::Full},
            {"roi", observations::MapContent::Roi},
            {"roi+rays", observations::MapContent::RoiAndRays}},
           "all returns (full), RoI returns only (roi), or RoI returns plus free space "
           "from all rays (roi+rays, the default)")
        .valueName("full|roi|roi+rays")
        .needs(octomap)
        .group("Output");
    app.option("--octomap-resolution", conversion.octomap.resolution_m,
               "voxel size in metres (default: 0.2)")
        .between(0.01, 100.0)
        .valueName("M")
        .needs(octomap)
        .group("Output");
    app.option("--stats", conversion.stats,
               "JSON: settings, counts, latencies, per-scan data; -: standard output")
        .group("Output");
    const Flag learn =
        app.option("--learn-airframe", flags.learned_airframe,
                   "learn the vehicle's own returns from a flight, for 'airframe:' in "
                   "settings: writes FILE.yaml and a picture, no other output")
            .extension({".yaml"})
            .group("Output");
    app.option("--learn-seconds", flags.learn_seconds,
               "duration to learn from, after --from [s] (default: 10)")
        .between(0.1, 1e6)
        .valueName("S")
        .needs(learn)
        .group("Output");
    app.option("--pcap", flags.capture,
               "network capture of the packets in a rawlog or ROS recording, no other output")
        .extension({".pcap"})
        .group("Output");
    app.flag("--overwrite", conversion.overwrite, "replace existing outputs").group("Output");
    app.option("--jobs", conversion.jobs,
               "threads (default: all cores); does not affect the output")
        .between(1, 1024)
        .valueName("N")
        .group("Output");
    app.flag("-q,--quiet", flags.is_quiet, "print errors only").group("Output");

    app.option("-c,--config", flags.configs,
               "settings file, or the name of a preset such as hdl32e; may be repeated, later ones "
               "override earlier ones")
        .once()
        .group("Settings");
    app.option("--set", flags.keys, "KEY=VALUE: one key of the settings; may be repeated")
        .once()
        .group("Settings");
    app.flag("--config-dump", flags.dumps_settings, "print the current settings and exit")
        .group("Settings");
    app.printer("--config-keys", printSettingsKeys, "print the table of all settings and exit")
        .group("Settings");
    app.version(HAGEN_VERSION);
}

/// Rejects invalid combinations of flags.
void check(Flags& flags) {
    convert::Conversion& conversion = flags.conversion;
    try {
        if (!flags.bin_fields.empty()) {
            conversion.source.bin_fields = recordings::binFieldsOf(flags.bin_fields);
        }
    } catch (const std::runtime_error& e) {
        throw UsageError("--bin-fields", e.what());
    }
    if (flags.dumps_settings) return;
    if (conversion.input.empty()) throw UsageError("--input is required");
    const bool has_output = !conversion.rawlog.empty() || !conversion.folder.empty() ||
                            !conversion.pictures.empty() || !conversion.octomaps.empty() ||
                            !conversion.clouds.empty() || !conversion.mcap.empty() ||
                            !conversion.stats.empty() || !conversion.view.empty();
    if (!has_output && flags.learned_airframe.empty() && flags.capture.empty()) {
        throw UsageError(
            "an output (-o, --view, --kitti, --clouds, --mcap, --pictures, --octomap, --stats, "
            "--pcap or --learn-airframe) is required");
    }
    if (!flags.capture.empty() && (has_output || !flags.learned_airframe.empty())) {
        throw UsageError("--pcap", "excludes other outputs; run rawlog-segment again for them");
    }
    if (has_output && !flags.learned_airframe.empty()) {
        throw UsageError("--learn-airframe",
                         "excludes other outputs; learn first, then segment with the file in the "
                         "settings");
    }
    if (!conversion.poses.empty() && !flags.learned_airframe.empty()) {
        throw UsageError("--learn-airframe", "does not use poses: omit --poses");
    }
    if (!(flags.learn_seconds > 0)) throw UsageError("--learn-seconds", "must be positive");
    if (!(conversion.octomap.resolution_m > 0)) {  // NaN passes range checks
        throw UsageError("--octomap-resolution", "must be positive");
    }
    if (conversion.source.first_scan > conversion.source.last_scan) {
        throw UsageError("--from", "must not be greater than --to");
    }
}

void learn(const Flags& flags) {
    const convert::Conversion& conversion = flags.conversion;
    convert::AirframeLearning learning;
    learning.input = conversion.input;
    learning.source = conversion.source;
    learning.file = flags.learned_airframe;
    learning.overwrite = conversion.overwrite;
    learning.seconds = flags.learn_seconds;
    learning.settings = conversion.settings;
    convert::AirframeListener listener;
    listener.keep_going = [] { return !isInterrupted(); };
    listener.unreadable = [&](const std::string& entry, const std::string& why) {
        std::cerr << oneLine(conversion.input.string() + ": " + entry + ": skipped: " + why)
                  << "\n";
    };
    listener.remark = [&](const std::string& what) {
        if (!flags.is_quiet) {
            std::cerr << oneLine(conversion.input.string() + ": the recording: " + what) << "\n";
        }
    };
    const convert::AirframeReport report = convert::learnAirframe(learning, listener);
    if (!flags.is_quiet) printAirframe(learning, report);
}

void capture(const Flags& flags) {
    const convert::Conversion& conversion = flags.conversion;
    recordings::SourceOptions options = conversion.source;
    options.keep_going = [] { return !isInterrupted(); };
    const std::size_t packets =
        convert::capturePackets(conversion.input, options, flags.capture, conversion.overwrite);
    if (flags.is_quiet) return;
    std::cout << flags.capture.string() << ": " << counted(packets, "packet") << "\n";
}

int run(const Program& program, Flags& flags) {
    check(flags);
    try {
        for (const std::string& config : flags.configs) {
            mergeSettings(presetFile(config), flags.conversion.settings);
        }
        for (const std::string& key : flags.keys) mergeKey(key, flags.conversion.settings);
        if (flags.dumps_settings) {
            printSettings(flags.conversion);
            return kDone;
        }
        catchSignals();
        if (!flags.learned_airframe.empty()) {
            learn(flags);
            return kDone;
        }
        if (!flags.capture.empty()) {
            capture(flags);
            return kDone;
        }
        const convert::ConversionReport report = convertAloud(flags.conversion, flags.is_quiet);
        if (!flags.is_quiet && flags.conversion.stats != "-") {
            printSummary(flags.conversion, report);
        }
        if (report.scans > 0) return kDone;
        return program.fail(
            kFailed, flags.conversion.input.string() + (report.unreadable_scans == 0
                                                            ? ": no LiDAR scan was segmented"
                                                            : ": no LiDAR scan could be read"));
    } catch (const SettingsError& e) {
        return program.fail(kWrongUsage, e.what());
    }
}

int command(int argc, char** argv) {
    Program program(
        "rawlog-segment",
        "Segments LiDAR scans into near obstacles (RoI) and ground or distant returns (ROU) in a "
        "log.");
    program.footer(
        "Examples:\n"
        "  rawlog-segment flight.rawlog --view flight.html\n"
        "  rawlog-segment -i flight.rawlog -o segmented.rawlog --preview\n"
        "  rawlog-segment -i flight.rawlog --kitti labels -c paper\n"
        "  rawlog-segment -i flight.rawlog --pictures pictures --from 20 --to 25\n"
        "  rawlog-segment -i flight.rawlog --octomap map.bt --poses flight.tum\n"
        "  rawlog-segment -i scan_folder --kitti labels -c hdl64e\n"
        "  rawlog-segment -i flight.pcap -o segmented.rawlog\n"
        "  rawlog-segment -i clouds_folder --clouds labelled --cloud-format pcd\n"
        "  rawlog-segment -i flight.bag --mcap segmented.mcap\n"
        "  rawlog-segment -i ouster.pcap --sensor-json ouster.json -o segmented.rawlog\n"
        "  rawlog-segment -i flight.bag --topic /velodyne_points -o segmented.rawlog\n"
        "  rawlog-segment -i flight.rawlog --learn-airframe airframe.yaml\n"
        "Exit codes: 0 success; 1 runtime error, or no LiDAR scan; 2 wrong usage.");
    Flags flags;
    declare(program, flags);
    return program.run(argc, argv, [&] { return run(program, flags); });
}

}  // namespace

int main(int argc, char** argv) { return guarded(argc, argv, command); }
