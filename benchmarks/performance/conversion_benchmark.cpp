// Measures the run time of a conversion and of its parts.
#include <hagen/convert/Conversion.h>
#include <hagen/recordings/RawlogReader.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "ConversionTimes.h"
#include "base/command_line/CommandLine.h"

namespace {

using namespace hagen;
using namespace hagen::base;
namespace fs = std::filesystem;

/// A temporary folder for outputs.
struct WorkFolder {
    fs::path path =
        fs::temp_directory_path() / ("conversion-benchmark-" + std::to_string(getpid()));
    WorkFolder() { fs::create_directories(path); }
    ~WorkFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// CPU time of this process and of ended child processes [s].
double cpuTime_s() {
    double sum_s = 0;
    for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        getrusage(who, &usage);
        for (const timeval& time : {usage.ru_utime, usage.ru_stime}) {
            sum_s += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
        }
    }
    return sum_s;
}

/// Times of repeated runs. On a busy machine, CPU time is more reliable than wall time.
struct Times {
    std::vector<double> seconds, cpu_s;

    template <class Work>
    void add(const Work& work) {
        const double cpu_start_s = cpuTime_s();
        const auto start = std::chrono::steady_clock::now();
        work();
        seconds.push_back(
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        cpu_s.push_back(cpuTime_s() - cpu_start_s);
    }
};

void readThrough(const fs::path& log) {
    recordings::RawlogReader reader(log);
    while (reader.next()) {
    }
}

double peakMegabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

void measure(convert::Conversion conversion, int repetitions, const std::string& settings,
             const fs::path& json_lines) {
    const WorkFolder folder;
    conversion.rawlog = folder.path / "segmented.rawlog";
    conversion.overwrite = true;
    const convert::ConversionReport report =
        convert::convert(conversion);  // warm-up; also provides the counts
    if (report.scans == 0) throw std::runtime_error("the log has no LiDAR scan");

    ConversionTimes times;
    times.settings = settings;
    times.scans = report.scans;
    times.jobs = conversion.jobs;
    times.flight_s = report.scan_reports.back().time_s - report.scan_reports.front().time_s;
    times.peak_megabytes = peakMegabytes();
    Times converting, reading;
    std::vector<double> labelled_ms;
    for (int i = 0; i < repetitions; ++i) {
        convert::ConversionReport again;
        converting.add([&] { again = convert::convert(conversion); });
        labelled_ms.push_back(std::accumulate(
            again.scan_reports.begin(), again.scan_reports.end(), 0.0,
            [](double sum, const convert::ScanReport& scan) { return sum + scan.latency_ms; }));
        reading.add([&] { readThrough(conversion.input); });
    }
    const auto scans = static_cast<double>(report.scans);
    times.conversion_s = median(converting.seconds);
    times.cpu_ms = 1000 * median(converting.cpu_s) / scans;
    times.reading_ms = 1000 * median(reading.cpu_s) / scans;
    times.packets_to_labels_ms = median(labelled_ms) / scans;
    if (!json_lines.empty()) appendTo(json_lines, times);
    std::printf("%zu scans, %.1f s of flight, %zu job(s), medians of %d\n", times.scans,
                times.flight_s, times.jobs, repetitions);
    const auto line = [](const char* what, double value, const char* unit) {
        std::printf("  %-28s %8.3f %s\n", what, value, unit);
    };
    line("conversion", times.conversion_s, "s");
    line("real time", times.flight_s / times.conversion_s, "x");
    line("CPU time", times.cpu_ms, "ms per scan");
    line("CPU time of reading", times.reading_ms, "ms per scan");
    line("packets to labels", times.packets_to_labels_ms, "ms per scan");
    line("peak memory", times.peak_megabytes, "MB");
}

}  // namespace

int main(int argc, char** argv) {
    Program app("conversion-benchmark", "Times the conversion of a rawlog, as in rawlog-segment.");
    convert::Conversion conversion;
    std::vector<std::string> configs;
    int repetitions = 5;
    conversion.jobs = 1;
    app.option("log", conversion.input, "a .rawlog").existingFile().required();
    app.option("--jobs", conversion.jobs, "threads of the conversion; 0: all cores").showDefault();
    app.option("--repetitions", repetitions, "number of repetitions; medians are printed")
        .positive()
        .showDefault();
    app.option("-c,--config", configs,
               "settings file; may be repeated, later files override earlier ones")
        .once();
    std::string settings = "default", json_lines;
    app.option("--json", json_lines, "append one line of JSON to this file");
    app.option("--name", settings, "name of the settings, for --json").showDefault();
    return app.run(argc, argv, [&] {
        for (const std::string& config : configs) {
            mergeSettings(config, conversion.settings);
        }
        measure(conversion, repetitions, settings, json_lines);
        return kDone;
    });
}
