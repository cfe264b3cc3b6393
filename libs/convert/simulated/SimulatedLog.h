#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace hagen::convert {

/// Parameters of a simulated log and its outputs; outputs with an empty path are not written.
struct SimulatedLog {
    std::string scenario;
    std::string sensor = "VLP-16";
    std::uint64_t seed = 1;
    int scans = 0;
    double altitude_m = 2, speed_m_s = 4, tilt_sd_deg = 4;
    double every_s = 0.1;    ///< time between the starts of scans
    bool clear_air = false;  ///< without dust and returns from the vehicle itself
    double mount_roll_deg = 0, mount_pitch_deg = 0;  ///< tilt of the sensor on the level vehicle

    std::filesystem::path rawlog, folder, poses, capture;
    bool overwrite = false;
};

struct SimulationReport {
    int scans = 0;
    std::size_t returns = 0;
    std::size_t roi = 0, rou = 0, unclassified = 0;  ///< number of returns by label
};

/// Simulates the flight and writes
///
/// - a rawlog of CObservationVelodyneScan `lidar`, each at the time of its first firing, with
///   CObservationRobotPose `pose` of the vehicle at least every 50 ms during scans. The sensor is
///   at the vehicle's origin; its mount is in sensorPose. Scans without rings are
///   CObservationPointCloud (CPointsMapXYZI, without point times),
/// - a scan folder with ground truth, with the returns as decoded from the packets, if any,
/// - the vehicle's poses as a TUM file, and the packets, if any, as a network capture.
///
/// The same seed produces the same bytes. Throws std::invalid_argument for an unknown scenario or
/// sensor, and std::runtime_error if a file cannot be written or if `keep_going` returns false: the
/// output is then kept in partial files. The message names the files.
SimulationReport simulateLog(const SimulatedLog& log, const std::function<bool()>& keep_going);

}  // namespace hagen::convert
