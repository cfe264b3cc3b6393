// The labelled scans behind the tables.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "convert/simulated/SimulatedLog.h"

namespace hagen {

/// Labelled scans that have a row or a column of their own.
struct DataSet {
    std::string name;       ///< short
    std::string about;      ///< description for readers of the document
    std::string preset;     ///< settings file of its sensor, in config/
    std::string folder;     ///< a folder of scan folders
    std::string label_map;  ///< in config/; empty: labels are those of labels/
    std::vector<convert::SimulatedLog>
        flights;  ///< to be simulated in `folder`; empty: a recording
    float zone_m = 20, max_range_m = 20;
    bool is_altitude = false;    ///< part of the series over altitudes within the default zone
    bool has_all_rows = true;    ///< false: only the comparison of methods, no sweeps or ablations
    bool is_timed = false;       ///< whether run times are measured on it
    bool has_vegetation = true;  ///< false: real scans whose vegetation is not scored
    bool is_degraded = false;    ///< whether `default` is also scored on degraded copies
};

/// Size of the simulation.
struct SimulationSize {
    std::vector<std::uint64_t> seeds;
    int scans = 0;  ///< per flight
};

/// Returns the recordings in `labelled` (beams16/ and beams64/; empty: none) and the flights to be
/// simulated in `data`. Throws std::runtime_error if a recording is missing; the message names the
/// folder.
std::vector<DataSet> dataSets(const std::filesystem::path& labelled,
                              const std::filesystem::path& data, const SimulationSize& size);

/// Simulates the missing flights of a set. A stamp next to a flight's folder records how it was
/// made, including `tag` (the version of the simulation).
void makeFlights(const DataSet& set, const std::string& tag);

/// Returns the scan folders of a set, sorted.
std::vector<std::string> scanFolders(const DataSet& set);

}  // namespace hagen
