// Run times of several methods over long simulated flights.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace hagen {

/// Run times of each method for each scan of a flight.
struct FlightTimes {
    std::string scenario;
    std::vector<std::size_t> returns;  ///< number of returns of each scan
    struct OfMethod {
        std::string name;
        std::vector<double> runs_ms;
    };
    std::vector<OfMethod> methods;
};

/// Simulates a flight with a VLP-16, one scan every 0.1 s, and labels each scan with each method:
/// the filter with the paper's, the default and the fast settings, and all published baselines.
/// Measures the time from returns with known beam indices to labels.
FlightTimes timeFlight(const std::string& scenario, std::uint64_t seed, int scans);

}  // namespace hagen
