#include <hagen/sensors/LidarDriver.h>
#include <hagen/sensors/VelodyneModel.h>
#include "sensors/ouster/OusterSensor.h"
#include "sensors/velodyne/VelodyneCalibrationFile.h"

#include <stdexcept>

namespace hagen::sensors {
namespace {

constexpr const char* kLivox = "Mid-360";

bool isHdl64(const std::string& model) { return model == hdl64Model().name; }

}  // namespace

std::string driverModels(const std::string& separator) {
    std::string names;
    for (const VelodyneModel& model : velodyneModels()) names += model.name + separator;
    return names + hdl64Model().name + separator + kLivox;
}

void checkDriver(const std::string& model, const std::filesystem::path& sensor_json,
                 const std::filesystem::path& calibration) {
    if (!sensor_json.empty() && !model.empty()) {
        throw std::runtime_error("Ouster metadata contain the model: omit --model");
    }
    if (!calibration.empty() && !isHdl64(model)) {
        throw std::runtime_error(calibration.string() +
                                 ": only an HDL-64E uses a calibration file");
    }
    if (!sensor_json.empty() || model == kLivox) return;
    if (isHdl64(model)) {
        if (!calibration.empty()) return;
        throw std::runtime_error("an HDL-64E needs its calibration: --calibration FILE");
    }
    for (const VelodyneModel& known : velodyneModels()) {
        if (known.name == model) return;
    }
    throw std::runtime_error("'" + model + "' is not supported live; supported: " + driverModels() +
                             ". An Ouster needs its metadata: --sensor-json FILE");
}

std::unique_ptr<LidarDriver> makeDriver(const std::string& model,
                                        const std::filesystem::path& sensor_json,
                                        const std::filesystem::path& calibration) {
    checkDriver(model, sensor_json, calibration);
    if (!sensor_json.empty()) return makeOusterDriver(readOusterSensor(sensor_json));
    if (model == kLivox) return makeLivoxDriver();
    if (!isHdl64(model)) return makeVelodyneDriver(velodyneModel(model));
    const VelodyneCalibration of_hdl64 = readVelodyneCalibration(calibration);
    return makeVelodyneDriver(hdl64Model(), &of_hdl64);
}

}  // namespace hagen::sensors
