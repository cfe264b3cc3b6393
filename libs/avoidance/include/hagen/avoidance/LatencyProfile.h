#pragma once
#include <hagen/simulation/Random.h>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// Quantiles of each stage's run time, measured on one machine. Trials draw from them, and so do
/// not depend on the speed or load of the machine that runs them.
struct LatencyProfile {
    std::string machine, made_by, date;  ///< processor; program and version; ISO date
    /// By stage: "filter", "MODEL/update", "MODEL/GUIDANCE", "MODEL/GUIDANCE+PLANNER" (a planner's
    /// time depends on the guidance). Quantiles at 0, 1/(n-1), ..., 1 [ms].
    std::map<std::string, std::vector<double>> quantiles_ms;

    /// Draws a latency [ms]. Throws std::runtime_error, naming the stage, if it is missing.
    double draw_ms(const std::string& stage, simulation::Random& random) const;
    double median_ms(const std::string& stage) const;

    /// The latency [ms] below which this share (0..1) of a stage's latencies lies.
    double at_ms(const std::string& stage, double share) const;
};

/// `count` quantiles of the measurements; empty without measurements.
std::vector<double> quantilesOf(const std::vector<double>& measured_ms, int count = 201);

/// The profile as JSON, latencies rounded to the microsecond.
std::string textOf(const LatencyProfile& profile);

/// The inverse of textOf(). Throws std::runtime_error, naming the key.
LatencyProfile latencyProfileFrom(const std::string& text);

/// Reads a file in the format of textOf(). Throws std::runtime_error naming the file and the key.
LatencyProfile readLatencyProfile(const std::filesystem::path& file);

/// The contents of config/campaign/profile.json at build time.
LatencyProfile standardLatencyProfile();

}  // namespace hagen::avoidance
