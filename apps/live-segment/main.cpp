// Labels the packets of a LiDAR as they arrive, as near obstacles (RoI) or everything else (ROU).
#include <hagen/live/LiveSession.h>
#include <hagen/settings/Presets.h>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <hagen/base/OutputPath.h>
#include "base/NumberText.h"
#include "base/Text.h"
#include "base/TextStream.h"
#include "base/command_line/BackgroundPrinter.h"
#include "base/command_line/CommandLine.h"
#include "base/command_line/Interrupt.h"
#include "base/command_line/Terminal.h"

#include "Autopilot.h"
#include "LiveView.h"

namespace {

using namespace hagen;
using namespace hagen::base;
namespace fs = std::filesystem;

struct Flags {
    live::LiveOptions live;
    std::string listen, from_address, view;
    std::filesystem::path replay;
    double speed = 1;
    std::vector<std::string> configs, keys;
    bool overwrite = false, is_quiet = false;
    AutopilotFlags autopilot;
};

void declare(Program& app, Flags& flags) {
    app.option("--listen", flags.listen,
               "local IPv4 address (0.0.0.0: all) and port, such as 0.0.0.0:2368; joins "
               "multicast groups")
        .valueName("ADDRESS:PORT")
        .group("Input");
    app.option("--from-address", flags.from_address,
               "the sensor's IPv4 address (default: the first to send)")
        .valueName("IP")
        .group("Input");
    app.option("--replay", flags.replay,
               "recording with packets instead of a sensor: network capture (.pcap, .pcapng), "
               "rawlog or "
               "ROS recording (.bag, .mcap, .db3 or its folder)")
        .existingPath()
        .group("Input");
    app.option("--speed", flags.speed, "replay speed; requires --replay")
        .between(0.001, 1e6)
        .showDefault()
        .valueName("X")
        .group("Input");
    app.option("--model", flags.live.model, "sensor model: " + sensors::driverModels())
        .valueName("NAME")
        .group("Input");
    app.option("--calibration", flags.live.calibration,
               "HDL-64E calibration file (Velodyne's db.xml)")
        .existingFile()
        .group("Input");
    app.option("--sensor-json", flags.live.sensor_json,
               "Ouster metadata file (JSON), instead of --model")
        .existingFile()
        .group("Input");
    app.option("--duration", flags.live.duration_s,
               "stop after this many seconds (default: run until Ctrl-C)")
        .between(0.001, 1e9)
        .valueName("SECONDS")
        .group("Input");
    app.option("--record", flags.live.recording.file,
               "network capture of all received datagrams; with --mavlink, vehicle poses as "
               "FILE.tum beside FILE.pcap")
        .valueName("FILE.pcap")
        .group("Output");
    app.option("--view", flags.view,
               "serve a page that shows labels, directions and latency in a browser, on this "
               "computer, or on the given address")
        .valueName("[ADDRESS:]PORT")
        .group("Output");
    app.option("--stats", flags.live.stats, "JSON: packets, losses, latencies, nearest obstacles")
        .group("Output");
    app.flag("--overwrite", flags.overwrite, "replace existing outputs").group("Output");
    app.flag("-q,--quiet", flags.is_quiet, "print errors only").group("Output");
    declareAutopilot(app, flags.autopilot);
    app.option("-c,--config", flags.configs,
               "settings file or preset; may be repeated, later files override earlier ones and "
               "the preset of --model")
        .once()
        .group("Settings");
    app.option("--set", flags.keys, "KEY=VALUE: one key of the settings; may be repeated")
        .once()
        .group("Settings");
    app.version(HAGEN_VERSION);
}

void check(Flags& flags) {
    if (flags.listen.empty() == flags.replay.empty()) {
        throw UsageError("one of --listen and --replay is required");
    }
    if (flags.replay.empty() && flags.speed != 1) {
        throw UsageError("--speed", "requires --replay");
    }
    if (flags.live.model.empty() && flags.live.sensor_json.empty()) {
        throw UsageError("--model or, for an Ouster, --sensor-json is required; models: " +
                         sensors::driverModels());
    }
    checkAutopilot(flags.autopilot);
    flags.live.from_ip = live::ipFrom(flags.from_address);
    if (!flags.from_address.empty() && !flags.live.from_ip) {
        throw UsageError("--from-address", "'" + flags.from_address + "' is not an IPv4 address");
    }
    flags.live.replay = flags.replay;
    flags.live.overwrite = flags.live.recording.overwrite = flags.overwrite;
    try {
        sensors::checkDriver(flags.live.model, flags.live.sensor_json, flags.live.calibration);
    } catch (const std::runtime_error& e) {
        throw UsageError(e.what());
    }
}

/// A capture of the replayed recording. rawlog-segment extracts the packets of rawlogs and bags,
/// because live-segment does not load MRPT.
class PacketsOf {
 public:
    explicit PacketsOf(const Flags& flags) : capture_(flags.replay) {
        if (sensors::isCapture(flags.replay)) return;
        std::string name = (fs::temp_directory_path() / "live-segment-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) {
            throw std::runtime_error(name + ": " + std::strerror(errno));
        }
        folder_ = name;
        capture_ = folder_ / "packets.pcap";
        const fs::path program = fs::read_symlink("/proc/self/exe").parent_path();
        std::vector<std::string> words{program / "rawlog-segment", "-q", flags.replay, "--pcap",
                                       capture_};
        if (!flags.live.sensor_json.empty()) {
            words.insert(words.end(), {"--sensor-json", flags.live.sensor_json});
        }
        if (!flags.is_quiet) std::cerr << "reading packets from " << flags.replay.string() << "\n";
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        pid_t process = 0;
        const int error =
            posix_spawnp(&process, arguments[0], nullptr, nullptr, arguments.data(), environ);
        int status = 0;
        if (error != 0 || waitpid(process, &status, 0) != process || status != 0) {
            fs::remove_all(folder_);
            throw std::runtime_error(
                flags.replay.string() + ": cannot extract its packets" +
                (error != 0 ? ": " + words[0] + ": " + std::strerror(error) : " (see above)"));
        }
    }
    ~PacketsOf() {
        std::error_code ignored;
        if (!folder_.empty()) fs::remove_all(folder_, ignored);  // the open capture stays readable
    }
    PacketsOf(const PacketsOf&) = delete;
    PacketsOf& operator=(const PacketsOf&) = delete;

    const fs::path& capture() const { return capture_; }

 private:
    fs::path folder_, capture_;
};

using To = BackgroundPrinter::To;

class StatusLine {
 public:
    explicit StatusLine(bool quiet) : is_shown_(!quiet && isatty(STDERR_FILENO) != 0) {}

    /// `autopilot`: the state of the link; empty without one. `yaw_deg`: the sensor's.
    void show(const live::LiveReport& report, const live::LiveStatus& status,
              const std::string& autopilot, double yaw_deg, BackgroundPrinter& printer) const {
        if (!is_shown_) return;
        std::vector<std::string> parts{"nearest: none"};
        if (status.nearest_m > 0) {  // not NaN
            const long bearing_deg = (std::lround(status.nearest_deg + yaw_deg) + 720) % 360;
            char text[40];
            std::snprintf(text, sizeof text, "nearest %.1f m at %03ld°",
                          static_cast<double>(status.nearest_m), bearing_deg);
            parts[0] = text;
        }
        const auto add = [&](const std::string& part) { parts.push_back(part); };
        const bool has_latency = status.p50_s > 0;
        if (status.is_silent) add("silent");
        if (has_latency) {
            add(fixedText(status.turns_per_s, 1) + " Hz");
            add(fixedText(1e3 * status.p50_s, 1) + " ms");
        }
        if (!autopilot.empty()) add("autopilot " + autopilot);
        const auto addCount = [&](const std::string& what, std::size_t number) {
            if (number > 0) add(what + " " + std::to_string(number));
        };
        addCount("lost", report.lost);
        addCount("dropped", report.dropped);
        addCount("late", report.late);
        addCount("foreign", report.other_sensor + report.wrong_size);
        if (has_latency) {
            add("p99 " + fixedText(1e3 * status.p99_s, 1) + " ms");
            add("max " + fixedText(1e3 * status.max_s, 1) + " ms");
        }
        printer.printIfIdle(To::ErrorsInPlace, lineOf(parts, terminalColumns()));
    }
    /// The target for output that replaces the status line.
    To instead() const { return is_shown_ ? To::ErrorsInPlace : To::Errors; }

 private:
    bool is_shown_;
};

std::string summaryOf(const live::LiveReport& r) {
    base::TextStream text;
    text << counted(r.packets, "packet") << " in " << counted(r.scans, "turn") << ", " << r.lost
         << " lost, " << r.late << " late, " << r.duplicate << " duplicate, " << r.dropped
         << " dropped\nignored: " << counted(r.wrong_size, "datagram") << " of wrong size, "
         << r.other_sensor << " from other sensors, " << r.auxiliary << " position or IMU, "
         << r.unsound << " without valid data, " << r.too_late << " too late, " << r.uncertain
         << " with unknown mode\n"
         << counted(r.sectors, "sector") << ", " << counted(r.returns, "return") << ", " << r.roi
         << " RoI\n";
    if (r.latency.count() > 0) {
        const auto ms = [](double time_s) { return base::fixedText(1e3 * time_s, 2); };
        text << "latency from last packet to labels: p50 " << ms(r.latency.quantile_s(0.5))
             << ", p99 " << ms(r.latency.quantile_s(0.99)) << ", p99.9 "
             << ms(r.latency.quantile_s(0.999)) << ", max " << ms(r.latency.max_s()) << " ms\n";
    }
    for (const auto& file : r.recorded.files) text << "recorded: " << file.string() << "\n";
    return text.str();
}

/// The failures of a session; empty if there were none.
std::string failureOf(const live::LiveReport& report, const live::LiveOptions& options) {
    std::string failure = report.recorded.failure;
    if (report.recorded.left_out > 0) {
        failure += (failure.empty() ? "" : "; ") + options.recording.file.string() + ": " +
                   counted(report.recorded.left_out, "datagram") + " missing" +
                   (failure.empty() ? ": the disk was too slow" : "");
    }
    if (!report.stats_failure.empty()) {
        failure += (failure.empty() ? "" : "; ") + report.stats_failure;
    }
    if (!failure.empty() || report.packets > 0) return failure;
    std::string problem = "no packet from " + live::sensorName(options) + " received";
    if (report.other_sensor > 0) {
        problem += ", but " + std::to_string(report.other_sensor) + " from other sensors: check " +
                   (options.from_ip         ? "--from-address"
                    : options.model.empty() ? "--sensor-json"
                                            : "--model");
    }
    if (report.uncertain > 0) {
        problem += ", but " + std::to_string(report.uncertain) +
                   " from turns without the metadata's columns. Is the sensor in "
                   "another mode?";
    }
    return problem;
}

/// Serves the viewer and connects it to a session's listener.
std::unique_ptr<LiveView> viewLive(const Flags& flags, const live::AutopilotLink* link,
                                   live::LiveListener& listener) {
    LiveView::Settings settings;
    settings.address = flags.view;
    settings.heading = "live: " + live::sensorName(flags.live);
    settings.directions.body_from_sensor.linear() =
        bodyFromSensor(flags.autopilot, flags.live.settings);
    if (link != nullptr) {
        settings.directions_sent = [link] { return link->directions(); };
        settings.motion = [link] { return link->motionAt(live::steadyNow_s()); };
    }
    auto view = std::make_unique<LiveView>(std::move(settings));
    LiveView* const to = view.get();
    const live::LiveListener others = listener;
    listener.begin = [to, others](const SensorModel& sensor, const Options& options) {
        others.begin(sensor, options);
        to->begin(sensor, options);
    };
    listener.sector = [to, others](const live::LabelledSector& sector) {
        others.sector(sector);
        to->take(sector);
    };
    listener.status = [to, others, link](const auto& report, const auto& status) {
        others.status(report, status);
        to->show(report, status, link != nullptr ? link->state() : "");
    };
    return view;
}

/// The preset of a model, such as vlp16 of a VLP-16; empty if there is none.
fs::path presetOf(const std::string& model) {
    std::string name = lowerCase(model);
    name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
    return findPreset(name);
}

int run(const Program& program, Flags& flags) {
    check(flags);
    try {
        if (const fs::path preset = presetOf(flags.live.model); !preset.empty()) {
            mergeSettings(preset, flags.live.settings);
        }
        for (const std::string& config : flags.configs) {
            mergeSettings(presetFile(config), flags.live.settings);
        }
        for (const std::string& key : flags.keys) mergeKey(key, flags.live.settings);
        catchSignals();
        std::unique_ptr<live::PacketSource> source;
        if (!flags.replay.empty()) {
            const PacketsOf packets(flags);
            source = std::make_unique<live::ReplaySource>(packets.capture(), flags.speed);
        } else {
            live::Address address;
            try {
                address = live::parseAddress(flags.listen);
            } catch (const std::runtime_error& e) {
                throw UsageError("--listen", e.what());
            }
            source = std::make_unique<live::UdpSource>(address);
            if (!flags.is_quiet) std::cerr << "listening on " << flags.listen << "\n";
        }
        BackgroundPrinter printer;  // a suspended terminal must not stop labelling
        const StatusLine line(flags.is_quiet);
        std::unique_ptr<live::AutopilotLink> link;
        std::unique_ptr<LiveView> view;
        live::LiveListener listener;
        listener.keep_going = [] { return !isInterrupted(); };
        listener.status = [&](const auto& report, const auto& status) {
            line.show(report, status, link ? link->state() : "", flags.autopilot.sensor_yaw_deg,
                      printer);
        };
        listener.remark = [&](const std::string& remark) {  // may run on the autopilot's thread
            if (!flags.is_quiet) printer.print(line.instead(), remark + "\n");
        };
        std::string failure;
        int failed = kFailed;
        try {
            link = linkAutopilot(flags.autopilot, flags.live.settings, listener);
            if (!flags.view.empty()) {
                view = viewLive(flags, link.get(), listener);
                if (!flags.is_quiet) {
                    printer.print(line.instead(), "view: http://" +
                                                      (flags.view.find(':') == std::string::npos
                                                           ? "127.0.0.1:" + flags.view
                                                           : flags.view) +
                                                      "\n");
                }
            }
            const live::LiveReport report = live::runLive(*source, flags.live, listener);
            printer.print(line.instead(), "");
            if (!flags.is_quiet) {
                printer.print(To::Output,
                              summaryOf(report) + (link ? hagen::summaryOf(*link) : ""));
            }
            failure = failureOf(report, flags.live);
        } catch (const UsageError&) {
            throw;
        } catch (const SettingsError& e) {
            failure = e.what();
            failed = kWrongUsage;
        } catch (const std::exception& e) {  // the background printer prints the message
            printer.print(line.instead(), "");
            failure = Program::messageOf(e);
        }
        if (!failure.empty()) printer.print(To::Errors, "live-segment: " + failure + "\n");
        if (!printer.finish()) {
            // The terminal is blocked, so exit() would hang flushing stdout. All files are
            // complete.
            view.reset();
            link.reset();
            const bool is_done = failure.empty() && printer.isOutputPrinted();
            std::_Exit(is_done ? kDone : failure.empty() ? kFailed : failed);
        }
        return failure.empty() ? kDone : failed;
    } catch (const SettingsError& e) {
        return program.fail(kWrongUsage, e.what());
    }
}

int command(int argc, char** argv) {
    Program program(
        "live-segment",
        "Segments the packets of a LiDAR into near obstacles (RoI) and ground or distant "
        "returns (ROU) while it rotates.");
    program.footer(
        "Examples:\n"
        "  live-segment --listen 0.0.0.0:2368 --model VLP-16 --record flight.pcap\n"
        "  live-segment --replay flight.pcap --model HDL-32E --stats flight.json\n"
        "  live-segment --listen 0.0.0.0:2368 --model VLP-16 --mavlink udp:192.168.1.10:14550\n"
        "Exit codes: 0 success, 1 runtime error, 2 wrong usage.");
    Flags flags;
    declare(program, flags);
    return program.run(argc, argv, [&] { return run(program, flags); });
}

}  // namespace

int main(int argc, char** argv) { return guarded(argc, argv, command); }
