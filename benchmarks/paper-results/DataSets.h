// The labelled scans used for the tables.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "convert/simulated/SimulatedLog.h"

namespace hagen {

/// Labelled scans with a row or column of their own.
struct DataSet {
    std::string name;                            ///< short name
    std::string about;                           ///< description for readers of the document
    std::string preset;                          ///< settings file of the sensor, in config/
    std::string folder;                          ///< a folder of scan folders
    std::string label_map;                       ///< file in config/; empty: labels/ as is
    std::vector<convert::SimulatedLog> flights;  ///< simulated in `folder`; none for recordings
    float zone_m = 20, max_range_m = 20;
    bool is_altitude = false;    ///< part of the altitude series within the default zone
    bool has_all_rows = true;    ///< false: only compare methods, no sweeps or ablations
    bool is_timed = false;       ///< whether run times are measured
    bool has_vegetation = true;  ///< false: vegetation is not scored
    bool is_degraded = false;    ///< whether degraded copies are scored with `default`
};

/// Size of the simulation.
struct SimulationSize {
    std::vector<std::uint64_t> seeds;
    int scans = 0;  ///< scans per flight
};

/// Returns the recordings in `labelled` (beams16/ and beams64/; none if `labelled` is empty) and
/// the flights to simulate in `data`. Throws std::runtime_error naming the folder of a missing
/// recording.
std::vector<DataSet> dataSets(const std::filesystem::path& labelled,
                              const std::filesystem::path& data, const SimulationSize& size);

/// Simulates the missing flights of a set. A stamp next to a flight's folder records the command
/// and `tag` (the simulation version).
void makeFlights(const DataSet& set, const std::string& tag);

/// Returns the scan folders of a set, sorted.
std::vector<std::string> scanFolders(const DataSet& set);

}  // namespace hagen
