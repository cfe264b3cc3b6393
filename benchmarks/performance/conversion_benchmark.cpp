// Measures the run time of a conversion, compared with reading the log and writing the same bytes
// without segmentation.
#include <hagen/convert/Conversion.h>
#include <hagen/recordings/RawlogReader.h>
#include <mrpt/obs/CObservation.h>
#include <sys/resource.h>
#include <unistd.h>
#include "convert/RawlogWriter.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <numeric>
#include <optional>
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

/// Times of repeated runs. On a busy machine, CPU time is more reliable than wall time.
struct Times {
    std::vector<double> seconds, processor_s;

    template <class Work>
    void add(const Work& work) {
        const std::clock_t processor_start = std::clock();
        const auto start = std::chrono::steady_clock::now();
        work();
        seconds.push_back(
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        processor_s.push_back(static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC);
    }
};

bool isResult(const mrpt::serialization::CSerializable& entry) {
    const auto* observation = dynamic_cast<const mrpt::obs::CObservation*>(&entry);
    if (observation == nullptr) return false;
    const std::string& label = observation->sensorLabel;
    for (const std::string ending : {"_roi", "_preview"}) {
        const bool ends_so =
            label.size() >= ending.size() &&
            label.compare(label.size() - ending.size(), ending.size(), ending) == 0;
        if (ends_so) return true;
    }
    return false;
}

/// The content of a segmented log: for each input entry, its bytes and its results.
std::vector<convert::Bytes> groupsOf(const fs::path& segmented) {
    std::vector<convert::Bytes> groups;
    recordings::RawlogReader reader(segmented);
    while (const auto entry = reader.next()) {
        if (groups.empty() || !isResult(*entry)) groups.emplace_back();
        convert::serialise(*entry, groups.back());
    }
    return groups;
}

/// Reads every object of a log and writes the given bytes.
void copyThrough(const fs::path& log, const std::vector<convert::Bytes>& groups,
                 const fs::path& out) {
    recordings::RawlogReader reader(log);
    convert::RawlogWriter writer(out, true);
    convert::Bytes entries, member, packed;
    for (const convert::Bytes& group : groups) {
        if (!reader.next()) throw std::runtime_error("the log has fewer entries than its copy");
        entries = group;
        writer.gather(entries, member);
        if (member.empty()) continue;
        convert::packGzipMember(member, packed);
        writer.writeMember(packed);
    }
    if (reader.next()) throw std::runtime_error("the log already contains results");
    writer.commit();
}

bool haveSameBytes(const fs::path& a, const fs::path& b) {
    std::ifstream in_a(a, std::ios::binary), in_b(b, std::ios::binary);
    return fs::file_size(a) == fs::file_size(b) &&
           std::equal(std::istreambuf_iterator<char>(in_a), {},
                      std::istreambuf_iterator<char>(in_b));
}

double peakMegabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

void measure(convert::Conversion conversion, bool copies_through, int repetitions,
             const std::string& settings, const fs::path& json_lines) {
    const WorkFolder folder;
    conversion.rawlog = folder.path / "segmented.rawlog";
    conversion.overwrite = true;
    const convert::ConversionReport report =
        convert::convert(conversion);  // warm-up; also provides the counts
    if (report.scans == 0) throw std::runtime_error("the log has no LiDAR scan");
    const double peak_megabytes = peakMegabytes();  // before all results are loaded
    const double flight_s = report.scan_reports.back().time_s - report.scan_reports.front().time_s;

    std::vector<convert::Bytes> groups;
    const fs::path copy = folder.path / "copy.rawlog";
    if (copies_through) groups = groupsOf(conversion.rawlog);

    Times converting, copying;
    std::vector<double> labelled_s;
    for (int i = 0; i < repetitions; ++i) {
        convert::ConversionReport again;
        converting.add([&] { again = convert::convert(conversion); });
        labelled_s.push_back(std::accumulate(again.scan_reports.begin(), again.scan_reports.end(),
                                             0.0, [](double sum, const convert::ScanReport& scan) {
                                                 return sum + scan.latency_ms / 1000;
                                             }));
        if (!copies_through) continue;
        copying.add([&] { copyThrough(conversion.input, groups, copy); });
        if (!haveSameBytes(conversion.rawlog, copy)) throw std::runtime_error("the copy differs");
    }

    const auto scans = static_cast<double>(report.scans);
    std::printf("%zu scans, %.1f s of flight, %zu job(s), medians of %d\n", report.scans, flight_s,
                conversion.jobs, repetitions);
    const auto line = [&](const char* what, const Times& times) {
        const double seconds = median(times.seconds);
        std::printf("  %-28s %8.3f s, CPU time %8.3f s, %7.3f ms per scan\n", what, seconds,
                    median(times.processor_s), 1000 * median(times.processor_s) / scans);
    };
    if (!json_lines.empty()) {
        ConversionTimes times;
        times.settings = settings;
        times.scans = report.scans;
        times.flight_s = flight_s;
        times.jobs = conversion.jobs;
        times.conversion_s = median(converting.seconds);
        times.conversion_processor_s = median(converting.processor_s);
        times.packets_to_labels_s = median(labelled_s);
        times.peak_megabytes = peak_megabytes;
        if (copies_through) {
            times.copy_s = median(copying.seconds);
            times.copy_processor_s = median(copying.processor_s);
        }
        appendTo(json_lines, times);
    }
    line("conversion", converting);
    std::printf("  %-28s %8.3f s, summed over jobs\n", "packets to labels", median(labelled_s));
    std::printf("  %-28s %8.1f x\n", "real time", flight_s / median(converting.seconds));
    std::printf("  %-28s %8.0f MB\n", "peak memory", peak_megabytes);
    if (!copies_through) return;
    line("copy of the same bytes, 1 job", copying);
    std::printf("  %-28s %8.2f    CPU time %8.2f\n", "conversion / copy",
                median(converting.seconds) / median(copying.seconds),
                median(converting.processor_s) / median(copying.processor_s));
}

}  // namespace

int main(int argc, char** argv) {
    Program app("conversion-benchmark", "Times the conversion of a rawlog, as in rawlog-segment.");
    convert::Conversion conversion;
    std::vector<std::string> configs;
    bool copies_through = false;
    int repetitions = 5;
    conversion.jobs = 1;
    app.option("log", conversion.input, "a .rawlog").existingFile().required();
    app.flag("--copy-through", copies_through,
             "compare with reading the log and writing the same bytes without segmentation");
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
        measure(conversion, copies_through, repetitions, settings, json_lines);
        return kDone;
    });
}
