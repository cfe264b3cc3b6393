#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace hagen::simulated_logs {

/// What is to be simulated, and where it goes; an empty path: nowhere.
struct SimulatedLog {
    std::string scenario;
    std::string sensor = "VLP-16";
    std::uint64_t seed = 1;
    int scans = 0;
    double altitude_m = 2, speed_m_s = 4, tilt_sd_deg = 4;
    double every_s = 0.1;    ///< from the start of a scan to that of the next
    bool clear_air = false;  ///< no dust, and nothing of the vehicle in the sensor's view

    std::filesystem::path rawlog, folder, poses;
    bool overwrite = false;
};

struct SimulationReport {
    int scans = 0;
    std::size_t returns = 0;
    std::size_t roi = 0, rou = 0, unclassified = 0;  ///< of them
};

/// Simulates the flight and writes
///
/// - a rawlog of CObservationVelodyneScan `lidar`, each at the time of its first firing, with
///   CObservationRobotPose `pose` at least every 50 ms while the sensor measures (the sensor sits
///   in the vehicle's origin),
/// - a scan folder with the truth (see TruthFolder.h), of the returns as decoded from the packets,
///   for sensors that have packets,
/// - the poses as a TUM file.
///
/// The same seed makes the same bytes. Throws std::invalid_argument for an unknown scenario or
/// sensor, std::runtime_error, naming the file, where one cannot be written, and where `keep_going`
/// says no: what was made until then is kept as parts of the outputs, which the message names.
SimulationReport simulateLog(const SimulatedLog& log, const std::function<bool()>& keep_going);

}  // namespace hagen::simulated_logs
