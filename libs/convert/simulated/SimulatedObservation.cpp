#include <hagen/convert/SimulatedObservation.h>

#include "mrpt/VelodyneEncoder.h"

namespace hagen::convert {

mrpt::poses::CPose3D mrptPose(const simulation::SensorPose& pose) {
    const Eigen::Quaterniond& q = pose.attitude;
    return {mrpt::math::CQuaternionDouble(q.w(), q.x(), q.y(), q.z()), pose.position_m.x(),
            pose.position_m.y(), pose.position_m.z()};
}

mrpt::obs::CObservationVelodyneScan::Ptr encodeSimulatedScan(const simulation::SimulatedScan& scan,
                                                             const SensorModel& sensor,
                                                             double hour_s) {
    const sensors::VelodyneModel& model = sensors::velodyneModel(sensor.name);
    const simulation::FiringPattern pattern = simulation::firingPattern(sensor);
    observations::Firings firings;
    firings.first_azimuth_deg = simulation::kFirstAzimuth_deg;
    firings.azimuth_step_deg = pattern.azimuthStep_deg();
    firings.first_time_us = static_cast<std::uint32_t>(1e6 * hour_s + 0.5);
    firings.range_m.setConstant(model.lasers, pattern.firings_per_revolution, kNoValue);
    firings.intensity.setZero(model.lasers, pattern.firings_per_revolution);
    for (std::size_t i = 0; i < scan.size(); ++i) {
        firings.range_m(scan.laser[i], scan.firing[i]) = scan.scan.range_m[i];
        firings.intensity(scan.laser[i], scan.firing[i]) = scan.scan.intensity[i];
    }
    auto observation = observations::encodeScan(model, firings);
    observation->minRange = static_cast<double>(sensor.min_range_m);
    observation->maxRange = static_cast<double>(sensor.max_range_m);
    return observation;
}

}  // namespace hagen::convert
