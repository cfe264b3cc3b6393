#include "with_mrpt/Simulation.h"

#include <hagen/convert/SimulatedObservation.h>
#include <hagen/mrpt/LocatedCloud.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/scan/Angle.h>
#include <hagen/simulation/LogClock.h>
#include <hagen/simulation/ObjectClass.h>
#include <hagen/simulation/Scenarios.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "Arrays.h"
#include "GilRelease.h"
#include "Limits.h"
#include "with_mrpt/Recorded.h"

namespace hagen::python {

namespace {

/// Checks the request against the limits of rawlog-simulate.
const SimulationRequest& checked(const SimulationRequest& request) {
    checkLimits("scans", request.scans, 1, 100000);
    checkLimits("altitude_m", request.altitude_m, 1, 15);
    checkLimits("speed_m_s", request.speed_m_s, 0.1, 20);
    checkLimits("tilt_sd_deg", request.tilt_sd_deg, 0, 15);
    checkLimits("every_s", request.every_s, 0.1, 3600);
    return request;
}

simulation::FlightSettings flightOf(const SimulationRequest& request) {
    simulation::FlightSettings settings;
    settings.altitude_m = request.altitude_m;
    settings.speed_m_s = request.speed_m_s;
    settings.tilt_sd_rad = radians(request.tilt_sd_deg);
    return settings;
}

/// Returns packets if the sensor has a packet format, otherwise a cloud with known beams.
mrpt::obs::CObservation::Ptr observationOf(const simulation::SimulatedScan& made,
                                           const SensorModel& sensor, double time_s) {
    mrpt::obs::CObservation::Ptr observation;
    if (sensor.name == "VLP-16" || sensor.name == "HDL-32E") {
        observation = convert::encodeSimulatedScan(made, sensor, std::fmod(time_s, 3600.0));
    } else {
        const auto cloud = mrpt::obs::CObservationPointCloud::Create();
        cloud->pointcloud = std::make_shared<observations::LocatedCloud>(
            made.scan, std::make_shared<const SensorModel>(sensor));
        observation = cloud;
    }
    observation->sensorLabel = "lidar";
    observation->timestamp = mrpt::Clock::fromDouble(simulation::kSimulatedLogStart_s + time_s);
    return observation;
}

}  // namespace

Simulation::Simulation(const SimulationRequest& request)
    : request_(checked(request)),
      sensor_(sensorModel(request.sensor)),
      scene_(simulation::makeScene(request.scenario, request.seed)),
      flight_(scene_.terrain(), scene_.path(), flightOf(request), request.seed),
      faults_(simulation::sensorErrors(sensor_)),
      random_(request.seed, 3) {  // the random stream of rawlog-simulate, for the same scans
    simulation::firingPattern(sensor_);
    if (request.clear_air) {
        faults_.dust_per_m = 0;
        faults_.airframe = false;
    }
}

std::optional<PythonScan> Simulation::next() {
    simulation::SimulatedScan made;
    recordings::RecordedScan recorded;
    {
        const GilRelease gil_release;
        const std::lock_guard lock(simulating_);
        if (made_ >= request_.scans) return std::nullopt;
        const double time_s = request_.every_s * made_;
        recorded.entry = static_cast<std::size_t>(made_++);
        made = simulation::simulateScan(scene_, sensor_, flight_, time_s, random_, faults_);
        recorded.observation = observationOf(made, sensor_, time_s);
    }
    const mrpt::poses::CPose3D pose = convert::mrptPose(made.pose);
    recorded.pose.sensor_pose = pose;
    recorded.pose.pose_has_horizon = true;
    recorded.pose.attitude =
        Attitude{static_cast<float>(pose.roll()), static_cast<float>(pose.pitch())};
    PythonScan scan = pythonScanOf({std::move(recorded), nullptr});
    if (static_cast<std::size_t>(scan.xyz.shape(0)) != made.size())
        throw std::logic_error("the packets differ from the simulated returns");

    std::vector<std::uint8_t> truth, kind;
    for (const simulation::ObjectClass of_return : made.kind) {
        truth.push_back(static_cast<std::uint8_t>(simulation::labelOf(of_return)));
        kind.push_back(static_cast<std::uint8_t>(of_return));
    }
    scan.truth = copied(truth);
    scan.kind = copied(kind);
    scan.object = copied(made.object);
    scan.altitude_m = made.altitude_m;
    return scan;
}

}  // namespace hagen::python
