// The labelled scans that the tables are made from.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <hagen/simulated_logs/SimulatedLog.h>

namespace hagen {

/// Labelled scans that have a line or a column of their own.
struct DataSet {
    std::string name;       ///< short
    std::string about;      ///< for those who read the document
    std::string preset;     ///< settings file of its sensor, in config/
    std::string folder;     ///< a folder of scan folders
    std::string label_map;  ///< in config/, or empty: labels are those of labels/
    std::vector<simulated_logs::SimulatedLog>
        flights;  ///< what is to be in `folder`; empty: it is a recording
    float zone_m = 20, max_range_m = 20;
    bool is_altitude = false;  ///< one of the series over altitudes within the usual zone
    bool has_all_rows = true;  ///< else only the methods side by side, no sweeps or ablations
    bool is_timed = false;     ///< run times are taken on it
};

/// How much is simulated.
struct SimulationSize {
    std::vector<std::uint64_t> seeds;
    int scans = 0;  ///< a flight
};

/// Recordings below `labelled` (beams16/ and beams64/; empty: none) and flights that are to lie
/// below `data`. Throws std::runtime_error, naming the folder, where a recording is missing.
std::vector<DataSet> dataSets(const std::filesystem::path& labelled,
                              const std::filesystem::path& data, const SimulationSize& size);

/// Makes the flights of a set, but for those that are there already: beside a flight's folder
/// a stamp says what made it, `tag` (the version of the simulation) included.
void makeFlights(const DataSet& set, const std::string& tag);

/// The scan folders of a set, sorted.
std::vector<std::string> scanFolders(const DataSet& set);

}  // namespace hagen
