#include <hagen/observations/VelodyneModel.h>
#include <cmath>
#include <mutex>
#include <stdexcept>

namespace hagen::observations {

using mrpt::obs::VelodyneCalibration;

namespace {

const std::vector<VelodyneModel>& models() {
    static const std::vector<VelodyneModel> known{{"VLP-16", 0x22, 16, 2, 2.304, 55.296, "VLP16"},
                                                  {"HDL-32E", 0x21, 32, 1, 1.152, 46.080, "HDL32"}};
    return known;
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
    throw std::invalid_argument("there is no packet format for '" + name +
                                "', only for VLP-16 and HDL-32E");
}

double azimuthOfReadingDeg(double reading) {
    double from_behind = std::fmod(reading + 18000.0, 36000.0);
    if (from_behind < 0) from_behind += 36000.0;
    return from_behind * (360.0 / 35999.0) - 180.0;
}

const VelodyneCalibration& defaultCalibration(const VelodyneModel& model) {
    static std::mutex mutex;  // MRPT loads them at their first use, which is not thread-safe
    const std::lock_guard<std::mutex> lock(mutex);
    return VelodyneCalibration::LoadDefaultCalibration(model.calibration);
}

std::uint8_t rowOfLaser(const VelodyneCalibration& calibration, std::size_t laser) {
    const auto& lasers = calibration.laser_corrections;
    const double sine = lasers[laser].sinVertCorrection;
    int lower = 0;
    for (std::size_t other = 0; other < lasers.size(); ++other) {
        const double other_sine = lasers[other].sinVertCorrection;
        if (other_sine < sine || (other_sine == sine && other < laser)) ++lower;
    }
    return static_cast<std::uint8_t>(lower);
}

std::vector<std::uint8_t> rowsOfLasers(const VelodyneCalibration& calibration) {
    std::vector<std::uint8_t> rows(calibration.laser_corrections.size());
    for (std::size_t laser = 0; laser < rows.size(); ++laser) {
        rows[laser] = rowOfLaser(calibration, laser);
    }
    return rows;
}

void beamsOf(const VelodyneCalibration& calibration, std::vector<float>& elevations_rad) {
    elevations_rad.resize(calibration.laser_corrections.size());
    for (std::size_t laser = 0; laser < elevations_rad.size(); ++laser) {
        // Sine and cosine are correct in every calibration; the angle's unit differs between files.
        const auto& correction = calibration.laser_corrections[laser];
        elevations_rad[rowOfLaser(calibration, laser)] = static_cast<float>(
            std::atan2(correction.sinVertCorrection, correction.cosVertCorrection));
    }
}

SensorModel sensorOf(const VelodyneCalibration& calibration, const std::string& name) {
    SensorModel sensor;
    sensor.name = name;
    beamsOf(calibration, sensor.elevations_rad);
    return sensor;
}

}  // namespace hagen::observations
