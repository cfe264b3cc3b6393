// Segments the scans of a log over and over, in one process, and looks for what grows: memory,
// latency, differences between the labels of equal scans.
#include <hagen/base/MemoryLimit.h>
#include <hagen/command_line/CommandLine.h>
#include <hagen/command_line/Interrupt.h>
#include <hagen/logs/RawlogReader.h>
#include <hagen/observations/ObservationScan.h>
#include <hagen/observations/ObservationSegmenter.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace hagen;
using Clock = std::chrono::steady_clock;

/// FNV-1a of all labels and obstacles of a scan.
std::uint64_t hashOf(const LabelledReturns& returns) {
    std::uint64_t hash = 14695981039346656037u;
    const auto add = [&](std::uint64_t value) { hash = (hash ^ value) * 1099511628211u; };
    for (const Label label : returns.label) add(static_cast<std::uint64_t>(label));
    for (const std::int32_t obstacle : returns.component) add(static_cast<std::uint32_t>(obstacle));
    return hash;
}

/// Resident memory of this process [bytes].
double residentBytes() {
    std::ifstream statm("/proc/self/statm");
    double all = 0, resident = 0;
    statm >> all >> resident;
    return 4096 * resident;
}

/// Counts latencies in steps of 10 us, so that a million of them take no memory.
class LatencyCounts {
 public:
    void add(double latency_us) {
        const auto step = static_cast<std::size_t>(latency_us / kStep_us);
        ++counts_[std::min(step, counts_.size() - 1)];
        ++all_;
        most_us_ = std::max(most_us_, latency_us);
    }
    double quantile_us(double share) const {
        std::uint64_t seen = 0;
        for (std::size_t step = 0; step < counts_.size(); ++step) {
            seen += counts_[step];
            if (static_cast<double>(seen) >= share * static_cast<double>(all_)) {
                return kStep_us * static_cast<double>(step + 1);
            }
        }
        return most_us_;
    }
    double most_us() const { return most_us_; }

 private:
    static constexpr double kStep_us = 10;
    std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(100'000);
    std::uint64_t all_ = 0;
    double most_us_ = 0;
};

/// The slope of a line through equally spaced values, per step (least squares).
double slopeOf(const std::vector<double>& values) {
    const double n = static_cast<double>(values.size());
    double mean = 0, covariance = 0, variance = 0;
    for (const double value : values) mean += value / n;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double x = static_cast<double>(i) - (n - 1) / 2;
        covariance += x * (values[i] - mean);
        variance += x * x;
    }
    return variance > 0 ? covariance / variance : 0;
}

struct Flags {
    std::string input, json;
    std::size_t scans = 1'000'000;
};

int soak(const Flags& flags) {
    std::vector<mrpt::obs::CObservation::Ptr> scans;
    logs::RawlogReader reader(flags.input);
    while (const auto entry = reader.next()) {
        const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry);
        if (scan && observations::isLidarScan(*scan)) scans.push_back(scan);
    }
    if (scans.empty()) throw std::runtime_error(flags.input + ": has no LiDAR scans");
    observations::ObservationSegmenter segmenter;
    segmenter.setMinLoggingLevel(mrpt::system::LVL_ERROR);
    segmenter.initialize(Settings());
    std::vector<std::uint64_t> first(scans.size(), 0);
    std::vector<double> resident;
    LatencyCounts latencies;
    std::size_t different = 0, done = 0;
    constexpr std::size_t kSamples = 1000, kRoundsOfWarmUp = 3;
    const std::size_t sample_every = std::max<std::size_t>(1, flags.scans / kSamples);
    for (; done < flags.scans && !command_line::isInterrupted(); ++done) {
        const std::size_t i = done % scans.size();
        const auto before = Clock::now();
        observations::ObservationSegmenter::Output out;
        segmenter.process(*scans[i], out);
        latencies.add(std::chrono::duration<double, std::micro>(Clock::now() - before).count());
        const std::uint64_t hash = hashOf(out.result->returns);
        if (done < scans.size()) first[i] = hash;
        different += hash != first[i];
        if (done >= kRoundsOfWarmUp * scans.size() && done % sample_every == 0) {
            resident.push_back(residentBytes());
        }
    }
    const double per_million = slopeOf(resident) / static_cast<double>(sample_every) * 1e6;
    char text[512];
    std::snprintf(
        text, sizeof text,
        "{\"scans\": %zu, \"different_labels\": %zu, \"p50_ms\": %.2f, \"p99_ms\": %.2f, "
        "\"p99.9_ms\": %.2f, \"p99.99_ms\": %.2f, \"max_ms\": %.2f, \"resident_mb\": %.1f, "
        "\"growth_mb_per_million_scans\": %.3f}\n",
        done, different, latencies.quantile_us(0.5) / 1e3, latencies.quantile_us(0.99) / 1e3,
        latencies.quantile_us(0.999) / 1e3, latencies.quantile_us(0.9999) / 1e3,
        latencies.most_us() / 1e3, residentBytes() / 1e6, per_million / 1e6);
    std::cout << text;
    if (!flags.json.empty()) std::ofstream(flags.json) << text;
    return different == 0 ? command_line::kDone : command_line::kFailed;
}

}  // namespace

int main(int argc, char** argv) {
    command_line::Program program("soak", "Segments the scans of a log many times in one process.");
    Flags flags;
    program.option("-i,--input", flags.input, "rawlog").required();
    program.option("--scans", flags.scans, "scans in all (default: 1000000)");
    program.option("--json", flags.json, "file for the figures");
    return program.run(argc, argv, [&] {
        command_line::catchSignals();
        return soak(flags);
    });
}
