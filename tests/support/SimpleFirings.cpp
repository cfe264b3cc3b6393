#include "support/SimpleFirings.h"

#include <hagen/scan/Angle.h>
#include <hagen/sensors/VelodyneCalibration.h>
#include <hagen/sensors/VelodynePacket.h>

#include <cstring>

#include "support/CaptureWriter.h"
#include "support/LaserRows.h"

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
    const std::vector<std::uint8_t> rows = rowsOfLasers(sensors::defaultCalibration(model));
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

std::vector<std::string> withSilentSector(const std::vector<std::string>& packets, double from_deg,
                                          double width_deg) {
    const double block_us = sensors::velodyneModel("VLP-16").blockPeriodUs();
    std::vector<std::string> limited;
    int blocks = 0;
    for (const std::string& bytes : packets) {
        sensors::VelodynePacket packet;
        std::memcpy(packet.bytes.data(), bytes.data(), bytes.size());
        for (int b = 0; b < sensors::kVelodyneBlocks; ++b) {
            if (packet.azimuthOf(b) < 0) continue;
            const double after_deg = 0.01 * packet.azimuthOf(b) - from_deg;
            if (after_deg - 360 * std::floor(after_deg / 360) < width_deg) continue;
            const auto place = static_cast<std::size_t>(blocks % sensors::kVelodyneBlocks);
            ++blocks;
            if (place == 0) {
                const double time_us = packet.sensorTimeUs() + b * block_us;
                const auto rounded_us = static_cast<std::uint32_t>(std::lround(time_us));
                std::string next(bytes.size(), '\0');
                next.replace(sensors::kVelodyneTimeAt, 6, bytes.substr(sensors::kVelodyneTimeAt));
                std::memcpy(&next[sensors::kVelodyneTimeAt], &rounded_us, sizeof rounded_us);
                limited.push_back(next);
            }
            const auto size = static_cast<std::size_t>(sensors::kVelodyneBlockBytes);
            limited.back().replace(size * place, size,
                                   bytes.substr(size * static_cast<std::size_t>(b), size));
        }
    }
    return limited;
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
