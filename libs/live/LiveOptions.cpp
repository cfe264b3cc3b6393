// Which sensors can be labelled and recorded live.
#include <hagen/live/LiveSession.h>
#include <hagen/observations/VelodyneModel.h>

#include <stdexcept>

#include "LiveSensor.h"

namespace hagen::live {

std::string liveModels() {
    std::string names;
    for (const char* name : {"VLP-16", "Puck Hi-Res", "HDL-32E", "VLP-32C", kHdl64, kLivox}) {
        names += (names.empty() ? " " : ", ") + std::string(name);
    }
    return names;
}

void checkLive(const LiveOptions& options) {
    if (!options.sensor_json.empty()) {
        if (!options.model.empty()) {
            throw std::runtime_error("an Ouster's metadata name its model: leave out --model");
        }
        if (!options.calibration.empty()) {
            throw std::runtime_error(options.calibration.string() + ": only an HDL-64E has one");
        }
        return;
    }
    const bool is_hdl64 = options.model == kHdl64;
    if (options.model != kLivox && !is_hdl64) {
        try {
            observations::velodyneModel(options.model);
        } catch (const std::invalid_argument&) {
            throw std::runtime_error("'" + options.model +
                                     "' cannot be labelled live; supported are" + liveModels() +
                                     ". An Ouster needs its metadata: --sensor-json FILE");
        }
    }
    if (is_hdl64 && options.calibration.empty()) {
        throw std::runtime_error("an HDL-64E needs its calibration: --calibration FILE");
    }
    if (!is_hdl64 && !options.calibration.empty()) {
        throw std::runtime_error(options.calibration.string() + ": only an HDL-64E has one");
    }
    if (options.model == kLivox && !options.recording.file.empty()) {
        throw std::runtime_error(
            "a Mid-360 cannot be recorded; record a capture and segment it with rawlog-segment");
    }
}

}  // namespace hagen::live
