#include <hagen/sensors/VelodyneModel.h>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace hagen::sensors {

const std::vector<VelodyneModel>& velodyneModels() {
    static const std::vector<VelodyneModel> known{
        {"VLP-16", 0x22, 16, 2, 1, 2.304, 55.296, 0.002f},
        {"Puck Hi-Res", 0x24, 16, 2, 1, 2.304, 55.296, 0.002f},
        {"HDL-32E", 0x21, 32, 1, 1, 1.152, 46.080, 0.002f},
        {"VLP-32C", 0x28, 32, 1, 2, 2.304, 55.296, 0.004f},
        {"VLS-128", 0xa1, 128, 1, 8, 2.665, 53.3, 0.004f}};
    return known;
}

const VelodyneModel* findVelodyneModel(std::uint8_t id) {
    for (const VelodyneModel& model : velodyneModels()) {
        if (model.id == id) return &model;
    }
    return nullptr;
}

const VelodyneModel& hdl64Model() {
    static const VelodyneModel model{"HDL-64E", 0, 64, 1, 64, 0.0, 48.0, 0.002f};
    return model;
}

const VelodyneModel& velodyneModel(std::string_view name) {
    for (const VelodyneModel& model : velodyneModels()) {
        if (model.name == name) return model;
    }
    throw std::invalid_argument("there is no packet format for '" + std::string(name) +
                                "', only for" + knownVelodynes());
}

std::string describeUnsupported(unsigned id) {
    char text[16];
    std::snprintf(text, sizeof text, "model id 0x%02x", id);
    // Leishen's packets have the format of Velodyne's.
    for (const auto& [known, name] : {std::pair{0x31u, "Velarray"},
                                      {0x63u, "VLS-128 prototype"},
                                      {0x10u, "Leishen C16"},
                                      {0x20u, "Leishen C32"}}) {
        if (known == id) return "an unsupported sensor (" + std::string(name) + ", " + text + ")";
    }
    return "an unknown Velodyne (" + std::string(text) + ")";
}

std::string knownVelodynes() {
    std::string names;
    for (const VelodyneModel& model : velodyneModels()) {
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

}  // namespace hagen::sensors
