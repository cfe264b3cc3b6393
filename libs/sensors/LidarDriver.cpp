#include <hagen/sensors/LidarDriver.h>
#include <hagen/sensors/VelodyneModel.h>
#include "base/Text.h"
#include "sensors/LidarFamily.h"
#include "sensors/ouster/OusterSensor.h"
#include "sensors/velodyne/VelodyneCalibrationFile.h"

#include <algorithm>
#include <stdexcept>

namespace hagen::sensors {
namespace {

/// Null: a Velodyne, or unknown.
const LidarFamily* familyOf(const std::string& model) {
    for (const LidarFamily& family : lidarFamilies()) {
        if (family.model == model) return &family;
    }
    return nullptr;
}

bool isHdl64(const std::string& model) { return model == hdl64Model().name; }

}  // namespace

std::string driverModels(const std::string& separator) {
    std::string names;
    for (const VelodyneModel& model : velodyneModels()) names += model.name + separator;
    names += hdl64Model().name;
    for (const LidarFamily& family : lidarFamilies()) names += separator + family.model;
    return names;
}

void checkDriver(const std::string& model, const std::filesystem::path& sensor_json,
                 const std::filesystem::path& calibration) {
    if (!sensor_json.empty() && !model.empty()) {
        throw std::runtime_error("Ouster metadata contain the model; omit --model");
    }
    if (!calibration.empty() && !isHdl64(model)) {
        throw std::runtime_error(calibration.string() +
                                 ": only an HDL-64E uses a calibration file");
    }
    if (!sensor_json.empty() || familyOf(model) != nullptr) return;
    if (isHdl64(model)) {
        if (!calibration.empty()) return;
        throw std::runtime_error("an HDL-64E requires its calibration; pass --calibration FILE");
    }
    const std::vector<std::string> known = base::split(driverModels("|"), '|');
    if (std::find(known.begin(), known.end(), model) != known.end()) return;
    throw std::runtime_error("'" + model + "' is not supported live" +
                             base::didYouMean(model, known) + " Supported: " + driverModels() +
                             ". For an Ouster, pass its metadata with --sensor-json FILE");
}

std::unique_ptr<LidarDriver> makeDriver(const std::string& model,
                                        const std::filesystem::path& sensor_json,
                                        const std::filesystem::path& calibration) {
    checkDriver(model, sensor_json, calibration);
    if (!sensor_json.empty()) return makeOusterDriver(readOusterSensor(sensor_json));
    if (const LidarFamily* const family = familyOf(model)) return family->makeDriver();
    if (!isHdl64(model)) return makeVelodyneDriver(velodyneModel(model));
    const VelodyneCalibration of_hdl64 = readVelodyneCalibration(calibration);
    return makeVelodyneDriver(hdl64Model(), &of_hdl64);
}

}  // namespace hagen::sensors
