#include "DataSets.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace hagen {
namespace {

namespace fs = std::filesystem;

constexpr double kEvery_s = 6;  // s; few scans must cover the whole path of a flight

std::string text(double value) {
    std::ostringstream stream;
    stream << value;
    return stream.str();
}

/// Content of a flight's stamp: the simulation command.
std::string commandOf(const convert::SimulatedLog& flight) {
    return "rawlog-simulate --scenario " + flight.scenario + " --sensor " + flight.sensor +
           " --seed " + std::to_string(flight.seed) + " --scans " + std::to_string(flight.scans) +
           " --altitude " + text(flight.altitude_m) + " --speed-m-s " + text(flight.speed_m_s) +
           " --tilt-sd-deg " + text(flight.tilt_sd_deg) + " --every-s " + text(flight.every_s);
}

std::string contentOf(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

DataSet recording(const fs::path& labelled, const std::string& beams, const std::string& preset) {
    DataSet set;
    set.name = "real, " + beams + " beams";
    set.about = "SemanticKITTI, " + beams + " beams, from a car";
    set.preset = preset;
    set.folder = (labelled / ("beams" + beams)).string();
    if (!fs::is_directory(set.folder)) {
        throw std::runtime_error(
            set.folder +
            ": no such folder; set HAGEN_LABELLED_DATA to its parent folder, or leave it unset");
    }
    set.label_map = "semantic_kitti.yaml";  // maps labels/ and classes
    set.is_timed = true;
    set.is_degraded = true;
    scanFolders(set);  // throws before the long simulation
    return set;
}

DataSet withoutVegetation(DataSet set) {
    set.name += ", no vegetation";
    set.about += "; vegetation is not scored";
    set.label_map = "semantic_kitti_without_vegetation.yaml";
    set.has_vegetation = false;
    set.has_all_rows = false;
    set.is_timed = false;
    set.is_degraded = false;
    return set;
}

DataSet flights(const std::string& name, const fs::path& folder,
                const std::vector<std::string>& scenarios, const std::vector<double>& altitudes_m,
                const std::string& sensor, const SimulationSize& size) {
    DataSet set;
    set.name = name;
    set.preset = sensor == "HDL-64E"   ? "hdl64e.yaml"
                 : sensor == "HDL-32E" ? "hdl32e.yaml"
                                       : "vlp16.yaml";
    set.folder = folder.string();
    std::string places;
    for (const std::string& scenario : scenarios) {
        places += (places.empty() ? "" : ", ") + scenario;
        for (const double altitude_m : altitudes_m) {
            for (const std::uint64_t seed : size.seeds) {
                convert::SimulatedLog flight;
                flight.scenario = scenario;
                flight.sensor = sensor;
                flight.seed = seed;
                flight.scans = size.scans;
                flight.altitude_m = altitude_m;
                flight.every_s = kEvery_s;
                flight.folder =
                    folder / (scenario + "-" + text(altitude_m) + "m-" + std::to_string(seed));
                set.flights.push_back(flight);
            }
        }
    }
    std::string heights;
    for (const double altitude_m : altitudes_m) {
        heights += (heights.empty() ? "" : " and ") + text(altitude_m);
    }
    set.about = "simulated " + sensor + " at " + heights + " m: " + places;
    return set;
}

}  // namespace

std::vector<DataSet> dataSets(const fs::path& labelled, const fs::path& data,
                              const SimulationSize& size) {
    std::vector<DataSet> sets;
    if (!labelled.empty()) {
        sets.push_back(recording(labelled, "16", "vlp16.yaml"));
        sets.push_back(withoutVegetation(sets.back()));
        sets.push_back(recording(labelled, "64", "hdl64e.yaml"));
        sets.push_back(withoutVegetation(sets.back()));
    }
    const std::vector<std::string> places{"orchard", "forest-0.05", "gap",
                                          "street",  "terrain",     "movers"};
    for (const double altitude_m : {1.5, 2.5, 4.0, 7.0}) {
        DataSet set =
            flights("simulated, " + text(altitude_m) + " m",
                    data / ("altitude-" + text(altitude_m)), places, {altitude_m}, "VLP-16", size);
        // At 7 m, the lowest beam meets level ground at 27 m, beyond the default zone.
        if (altitude_m > 5) {
            set.zone_m = set.max_range_m = 40;
            set.about += "; zone and score up to 40 m";
        }
        set.is_altitude = altitude_m <= 5;
        set.is_timed = altitude_m == 2.5;
        set.is_degraded = set.is_altitude;
        sets.push_back(set);
    }
    sets.push_back(flights("field", data / "field", {"field"}, {2.5}, "VLP-16", size));
    sets.push_back(flights("wires", data / "wires", {"wires"}, {2.5, 4.0}, "VLP-16", size));
    sets.back().about += " (poles, and wires of 24 mm); scored up to 10 m";
    sets.back().max_range_m = 10;
    for (const std::string sensor : {"HDL-32E", "HDL-64E"}) {
        sets.push_back(flights(sensor, data / sensor, {"street"}, {2.5}, sensor, size));
        sets.back().has_all_rows = false;
        sets.back().is_timed = true;
    }
    return sets;
}

void makeFlights(const DataSet& set, const std::string& tag) {
    if (set.flights.empty()) return;
    fs::create_directories(set.folder);
    for (convert::SimulatedLog flight : set.flights) {
        const fs::path stamp = flight.folder.string() + ".stamp";
        const std::string made_by = commandOf(flight) + "\nsimulation " + tag + "\n";
        if (fs::is_directory(flight.folder) && contentOf(stamp) == made_by) continue;
        fs::remove(stamp);  // no stamp until the simulation succeeds
        flight.overwrite = true;
        convert::simulateLog(flight, [] { return true; });
        std::ofstream out(stamp);
        out << made_by;
        out.close();
        if (!out) throw std::runtime_error(stamp.string() + ": cannot be written");
    }
}

std::vector<std::string> scanFolders(const DataSet& set) {
    std::vector<std::string> folders;
    if (!set.flights.empty()) {
        for (const convert::SimulatedLog& flight : set.flights)
            folders.push_back(flight.folder.string());
        return folders;
    }
    for (const auto& entry : fs::directory_iterator(set.folder)) {
        if (entry.is_directory()) folders.push_back(entry.path().string());
    }
    if (folders.empty()) throw std::runtime_error(set.folder + ": contains no scan folders");
    std::sort(folders.begin(), folders.end());
    return folders;
}

}  // namespace hagen
