// Records the packets that live-segment sends: a process of its own, so that labels go on whatever
// becomes of a recording.
#include <hagen/live/RecorderLink.h>
#include <hagen/recording/RecordPackets.h>
#include <hagen/settings/Settings.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <hagen/command_line/CommandLine.h>

namespace {

using namespace hagen;
using namespace hagen::command_line;

struct Flags {
    std::string model;
    std::filesystem::path sensor_json, calibration;
    std::vector<std::filesystem::path> settings_files, kept;
    recording::TurnRecorder::Options recording;
};

void declare(Program& app, Flags& flags) {
    app.option("--model", flags.model, "the sensor, as of live-segment").valueName("NAME");
    app.option("--sensor-json", flags.sensor_json, "metadata of an Ouster").valueName("FILE");
    app.option("--calibration", flags.calibration, "of an HDL-64E").valueName("FILE");
    app.option("--config", flags.settings_files, "settings file; may be repeated").once();
    app.option("--record", flags.recording.file, "the rawlog").required().valueName("FILE");
    app.option("--keep", flags.kept, "a file that no recording may replace; may be repeated")
        .once()
        .valueName("FILE");
    app.option("--rotate-bytes", flags.recording.rotate_bytes,
               "a new file whenever one is this long; 0: one file");
    app.flag("--overwrite", flags.recording.overwrite, "replaces existing files");
    app.flag("--wait", flags.recording.waits, "waits for the disk, and leaves no turn out");
    app.version(HAGEN_VERSION);
}

/// The socket of standard input; what reads that or prints from now on finds nothing, or the
/// standard error.
int takeSocket() {
    const int socket = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (nothing >= 0) dup2(nothing, STDIN_FILENO);
    dup2(STDERR_FILENO, STDOUT_FILENO);
    return socket;
}

bool hasSocket() {
    struct stat input {};
    return fstat(STDIN_FILENO, &input) == 0 && S_ISSOCK(input.st_mode);
}

/// What is recorded to, and what may not be replaced: inputs, and other outputs.
recording::TurnRecorder::Options recordingOf(const Flags& flags, const Settings& settings) {
    recording::TurnRecorder::Options options = flags.recording;
    options.others = flags.kept;
    options.others.insert(options.others.end(), {flags.sensor_json, flags.calibration});
    options.others.insert(options.others.end(), settings.files.begin(), settings.files.end());
    return options;
}

int run(const Flags& flags) {
    if (!hasSocket()) throw UsageError("live-segment --record starts this program, not you");
    const int socket = takeSocket();
    // It ends with its socket, after the last packet that came.
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) {
        std::signal(number, SIG_IGN);
    }
    std::unique_ptr<recording::SensorTurns> turns;
    std::optional<recording::TurnRecorder> recorder;
    try {
        Settings settings;
        for (const auto& file : flags.settings_files) mergeSettings(file, settings);
        turns = recording::makeSensorTurns(flags.model, flags.sensor_json, flags.calibration);
        recorder.emplace(recordingOf(flags, settings), settings);
    } catch (const std::exception& e) {
        live::sendLine(socket, live::failedLine(e.what()));
        return kFailed;
    }
    live::sendLine(socket, live::readyLine());
    const live::Recorded recorded = recordPackets(socket, *turns, *recorder);
    live::sendLine(socket, lineOf(recorded));
    return recorded.failure.empty() ? kDone : kFailed;
}

int command(int argc, char** argv) {
    Program program("live-record",
                    "Records the packets that come through standard input, a socket. live-segment "
                    "--record starts it.");
    Flags flags;
    declare(program, flags);
    return program.run(argc, argv, [&] { return run(flags); });
}

}  // namespace

int main(int argc, char** argv) { return guarded(argc, argv, command); }
