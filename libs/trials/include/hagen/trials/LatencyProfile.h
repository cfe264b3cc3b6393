#pragma once
#include <hagen/simulation/Random.h>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hagen::trials {

/// How long each stage took on some machine: quantiles of what was measured. Trials draw from it,
/// so that they do not depend on how fast, or how busy, the machine is that they run on.
struct LatencyProfile {
    std::string machine, made_by, date;  ///< processor; program and version; ISO date
    /// Stage names: "filter", "MODEL/update", "MODEL/GUIDANCE", "MODEL/GUIDANCE+PLANNER" (how
    /// long a planner takes depends on where it is sent). Of each, quantiles at 0, 1/(n-1), ..., 1
    /// [ms].
    std::map<std::string, std::vector<double>> quantiles_ms;

    /// Draws a latency [ms]. Throws std::runtime_error, naming the stage, for one it does not have.
    double draw_ms(const std::string& stage, simulation::Random& random) const;
    double median_ms(const std::string& stage) const;

    /// The latency [ms] below which this share of a stage's lies.
    double at_ms(const std::string& stage, double share) const;
};

/// A stage's quantiles, `count` of them, of what was measured. Of nothing, none.
std::vector<double> quantilesOf(std::vector<double> measured_ms, int count = 201);

/// The profile as a file holds it: JSON, latencies to the microsecond.
std::string textOf(const LatencyProfile& profile);

/// The opposite, to the microsecond. Throws std::runtime_error, naming the key.
LatencyProfile latencyProfileFrom(const std::string& text);

/// Read to the microsecond. Throw std::runtime_error, naming the file and the key.
LatencyProfile readLatencyProfile(const std::filesystem::path& file);
void writeLatencyProfile(const LatencyProfile& profile, const std::filesystem::path& file);

/// Those of config/campaign/profile.json when the program was built.
LatencyProfile standardLatencyProfile();

}  // namespace hagen::trials
