#include <hagen/observations/VelodyneModel.h>
#include <hagen/range_image/Angle.h>
#include <cmath>
#include <cstdio>
#include <map>
#include <mutex>
#include <stdexcept>

namespace hagen::observations {

using mrpt::obs::VelodyneCalibration;

namespace {

const std::vector<VelodyneModel>& models() {
    static const std::vector<VelodyneModel> known{
        {"VLP-16", 0x22, 16, 2, 1, 2.304, 55.296, 0.002f, "VLP16"},
        {"Puck Hi-Res", 0x24, 16, 2, 1, 2.304, 55.296, 0.002f, ""},
        {"HDL-32E", 0x21, 32, 1, 1, 1.152, 46.080, 0.002f, "HDL32"},
        {"VLP-32C", 0x28, 32, 1, 2, 2.304, 55.296, 0.004f, ""}};
    return known;
}

/// Where a laser points, as the manuals list them.
struct Beam {
    double elevation_deg;
    double azimuth_offset_deg = 0;  ///< clockwise
};

/// The beams of a model in the order in which its lasers fire; empty if MRPT has them.
std::vector<Beam> beamsOfManual(const std::string& name) {
    std::vector<Beam> beams;
    if (name == "Puck Hi-Res") {
        for (int i = 0; i < 8; ++i) {
            beams.push_back({-10.0 + i * 4.0 / 3.0});
            beams.push_back({2.0 / 3.0 + i * 4.0 / 3.0});
        }
    }
    if (name == "VLP-32C") {
        beams = {{-25, 1.4},    {-1, -4.2},     {-1.667, 1.4},  {-15.639, -1.4}, {-11.31, 1.4},
                 {0, -1.4},     {-0.667, 4.2},  {-8.843, -1.4}, {-7.254, 1.4},   {0.333, -4.2},
                 {-0.333, 1.4}, {-6.148, -1.4}, {-5.333, 4.2},  {1.333, -1.4},   {0.667, 4.2},
                 {-4, -1.4},    {-4.667, 1.4},  {1.667, -4.2},  {1, 1.4},        {-3.667, -4.2},
                 {-3.333, 4.2}, {3.333, -1.4},  {2.333, 1.4},   {-2.667, -1.4},  {-3, 1.4},
                 {7, -1.4},     {4.667, 1.4},   {-2.333, -4.2}, {-2, 4.2},       {15, -1.4},
                 {10.333, 1.4}, {-1.333, -1.4}};
    }
    return beams;
}

/// The calibrations that MRPT does not have, by name.
std::map<std::string, VelodyneCalibration> calibrationsOfManuals() {
    std::map<std::string, VelodyneCalibration> calibrations;
    for (const VelodyneModel& model : models()) {
        auto& lasers = calibrations[model.name].laser_corrections;
        for (const Beam& beam : beamsOfManual(model.name)) {
            auto& laser = lasers.emplace_back();
            laser.azimuthCorrection = -beam.azimuth_offset_deg;  // is subtracted
            laser.verticalCorrection = beam.elevation_deg;
            laser.sinVertCorrection = std::sin(radians(beam.elevation_deg));
            laser.cosVertCorrection = std::cos(radians(beam.elevation_deg));
            laser.sinVertOffsetCorrection = laser.cosVertOffsetCorrection = 0;
        }
    }
    return calibrations;
}

}  // namespace

const VelodyneModel* findVelodyneModel(std::uint8_t id) {
    for (const VelodyneModel& model : models()) {
        if (model.id == id) return &model;
    }
    return nullptr;
}

const VelodyneModel& hdl64Model() {
    static const VelodyneModel model{"HDL-64E", 0, 64, 1, 64, 0.0, 24.0, 0.002f, ""};
    return model;
}

const VelodyneModel& velodyneModel(const std::string& name) {
    for (const VelodyneModel& model : models()) {
        if (model.name == name) return model;
    }
    throw std::invalid_argument("there is no packet format for '" + name + "', only for" +
                                knownVelodynes());
}

std::string knownVelodynes() {
    std::string names;
    for (const VelodyneModel& model : models()) {
        char id[16];
        std::snprintf(id, sizeof id, " (0x%02x)", model.id);
        names += (names.empty() ? " " : ", ") + model.name + id;
    }
    return names;
}

double azimuthOfReadingDeg(double reading) {
    double from_behind = std::fmod(reading + 18000.0, 36000.0);
    if (from_behind < 0) from_behind += 36000.0;
    return from_behind * (360.0 / 35999.0) - 180.0;
}

const VelodyneCalibration& defaultCalibration(const VelodyneModel& model) {
    if (model.calibration.empty()) {
        static const auto of_manuals = calibrationsOfManuals();
        return of_manuals.at(model.name);
    }
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
