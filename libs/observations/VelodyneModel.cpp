#include <hagen/observations/VelodyneModel.h>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace hagen {
namespace {

const std::vector<VelodyneModel>& models() {
    static const std::vector<VelodyneModel> known{{"VLP-16", 0x22, 16, 2, 2.304, 55.296, "VLP16"},
                                                  {"HDL-32E", 0x21, 32, 1, 1.152, 46.080, "HDL32"}};
    return known;
}

/// Laser numbers from the lowest beam to the highest.
std::vector<std::size_t> lasersByElevation(const mrpt::obs::VelodyneCalibration& calibration) {
    const auto& lasers = calibration.laser_corrections;
    std::vector<std::size_t> order(lasers.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return lasers[a].sinVertCorrection < lasers[b].sinVertCorrection;
    });
    return order;
}

}  // namespace

const VelodyneModel* findVelodyneModel(std::uint8_t id) {
    for (const VelodyneModel& model : models()) {
        if (model.id == id) return &model;
    }
    return nullptr;
}

const VelodyneModel& velodyneModel(const std::string& name) {
    for (const VelodyneModel& model : models()) {
        if (model.name == name) return model;
    }
    throw std::invalid_argument("packets of '" + name + "' are not known; VLP-16 and HDL-32E are");
}

double azimuthOfReadingDeg(double reading) {
    double from_behind = std::fmod(reading + 18000.0, 36000.0);
    if (from_behind < 0) from_behind += 36000.0;
    return from_behind * (360.0 / 35999.0) - 180.0;
}

std::vector<std::uint8_t> rowsOfLasers(const mrpt::obs::VelodyneCalibration& calibration) {
    const std::vector<std::size_t> order = lasersByElevation(calibration);
    std::vector<std::uint8_t> rows(order.size());
    for (std::size_t row = 0; row < order.size(); ++row) {
        rows[order[row]] = static_cast<std::uint8_t>(row);
    }
    return rows;
}

SensorModel sensorOf(const mrpt::obs::VelodyneCalibration& calibration, const std::string& name) {
    SensorModel sensor;
    sensor.name = name;
    for (const std::size_t laser : lasersByElevation(calibration)) {
        // Sine and cosine are right in every calibration; the angle's unit differs between files.
        const auto& correction = calibration.laser_corrections[laser];
        sensor.elevations_rad.push_back(static_cast<float>(
            std::atan2(correction.sinVertCorrection, correction.cosVertCorrection)));
    }
    return sensor;
}

}  // namespace hagen
