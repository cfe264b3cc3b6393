#pragma once
#include <hagen/simulation/Flight.h>
#include <hagen/simulation/Lidar.h>
#include <hagen/simulation/Random.h>
#include <hagen/simulation/Scene.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "PythonScan.h"

namespace hagen::python {

/// Parameters of a simulation, like the flags of rawlog-simulate.
struct SimulationRequest {
    std::string scenario;
    int scans = 1;
    std::uint64_t seed = 1;
    std::string sensor = "VLP-16";
    double altitude_m = 2, speed_m_s = 4, tilt_sd_deg = 4, every_s = 0.1;
    bool clear_air = false;
};

/// A simulated flight whose scans Python iterates; they equal those of rawlog-simulate.
class Simulation {
 public:
    /// Throws std::invalid_argument for unknown names and numbers out of range.
    explicit Simulation(const SimulationRequest& request);

    /// The next scan; nullopt at the end. Requires the GIL, and releases it while simulating.
    std::optional<PythonScan> next();
    int scans() const { return request_.scans; }
    int left() const { return request_.scans - made_; }

 private:
    SimulationRequest request_;
    SensorModel sensor_;
    simulation::Scene scene_;
    simulation::Flight flight_;
    simulation::SensorErrorModel faults_;
    simulation::Random random_;
    std::mutex simulating_;  ///< locked without the GIL
    std::atomic<int> made_ = 0;
};

}  // namespace hagen::python
