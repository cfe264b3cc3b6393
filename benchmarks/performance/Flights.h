// Methods side by side over long simulated flights, and how evenly the filter runs.
#pragma once
#include <hagen/segmentation/Options.h>
#include <cstdint>
#include <string>
#include <vector>

namespace hagen {

/// Run times of each method over a flight, scan by scan.
struct FlightTimes {
    std::string scenario;
    std::vector<std::size_t> returns;  ///< of each scan
    struct OfMethod {
        std::string name;
        std::vector<double> runs_ms;
    };
    std::vector<OfMethod> methods;
};

/// Simulates a VLP-16's flight, a scan every 0.1 s, and has each method label each scan: the filter
/// with our settings and with the paper's, and all baselines as published. What is timed is the
/// call from returns that know their beam to labels.
FlightTimes timeFlight(const std::string& scenario, std::uint64_t seed, int scans);

/// How long the filter takes from a VLP-16 scan's packets to labels and lists of indices, `runs`
/// times over the scans of a simulated flight.
std::vector<double> packetsToLabels_ms(const Options& options, int runs);

}  // namespace hagen
