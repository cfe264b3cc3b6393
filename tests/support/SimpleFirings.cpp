#include "support/SimpleFirings.h"

#include <hagen/scan/Angle.h>
#include <hagen/sensors/VelodyneCalibration.h>

#include <cmath>

#include "support/CaptureWriter.h"

namespace hagen::test {

double firingAzimuthDeg(const sensors::VelodyneModel& model, const observations::Firings& firings,
                        int laser, int firing) {
    const double turn = firing + model.delayUs(laser) / model.firing_period_us;
    const double reading_deg = firings.first_azimuth_deg + turn * firings.azimuth_step_deg;
    const double correction_deg = sensors::defaultCalibration(model).lasers[laser].azimuth_deg;
    return sensors::azimuthOfReadingDeg(100.0 * (reading_deg - correction_deg));
}

observations::Firings fireAt(const SimpleScene& scene, const sensors::VelodyneModel& model,
                             const Eigen::Vector3d& position_m, const Eigen::Vector3d& velocity_m_s,
                             double range_limit_m) {
    const SensorModel sensor = sensorModel(model.name);
    const std::vector<std::uint8_t> rows =
        sensors::rowsOfLasers(sensors::defaultCalibration(model));
    observations::Firings firings;
    firings.azimuth_step_deg = 360.0 * model.firing_period_us / 100e3;  // 10 Hz
    const int count = static_cast<int>(std::round(360.0 / firings.azimuth_step_deg));
    firings.range_m.setConstant(model.lasers, count, kNoValue);
    firings.intensity.setZero(model.lasers, count);
    for (int firing = 0; firing < count; ++firing) {
        const double time_s = 1e-6 * model.firing_period_us * firing;
        const Eigen::Vector3d from_m = position_m + time_s * velocity_m_s;
        for (int laser = 0; laser < model.lasers; ++laser) {
            const double azimuth_rad = -radians(firingAzimuthDeg(model, firings, laser, firing));
            const double elevation_rad = static_cast<double>(sensor.elevations_rad[rows[laser]]);
            const Hit hit = castRay(scene, from_m, directionOf(azimuth_rad, elevation_rad));
            if (!(hit.range_m < range_limit_m)) continue;
            firings.range_m(laser, firing) = static_cast<float>(hit.range_m);
            firings.intensity(laser, firing) = hit.label == Label::Roi ? 0.8f : 0.2f;
        }
    }
    return firings;
}

std::vector<std::string> packetsOf(const sensors::VelodyneModel& model,
                                   const observations::Firings& firings) {
    std::vector<std::string> packets;
    for (const auto& packet : encodePackets(model, firings)) packets.push_back(bytesOf(packet));
    return packets;
}

std::vector<std::string> turnsOf(const SimpleScene& scene, const sensors::VelodyneModel& model,
                                 int turns, std::uint32_t first_us, bool is_dual) {
    observations::Firings firings = fireAt(scene, model, {0, 0, 2});
    if (is_dual) firings.last_range_m = firings.range_m;
    std::vector<std::string> packets;
    for (int k = 0; k < turns; ++k) {
        firings.first_time_us =
            static_cast<std::uint32_t>((first_us + 100000ull * k) % 3600000000ull);
        const auto turn = packetsOf(model, firings);
        packets.insert(packets.end(), turn.begin(), turn.end());
    }
    return packets;
}

mrpt::obs::CObservationVelodyneScan::Ptr poleScanFrom(double x_m, const std::string& label) {
    const SimpleScene scene = sceneOf({}, {{12, 2, 0.15, 8}});
    const sensors::VelodyneModel& model = sensors::velodyneModel("VLP-16");
    auto scan = observations::encodeScan(model, fireAt(scene, model, {x_m, 0, 2}));
    scan->sensorLabel = label;
    scan->timestamp = mrpt::Clock::fromDouble(100.0 + x_m);
    return scan;
}

}  // namespace hagen::test
