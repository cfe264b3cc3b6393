#include <hagen/avoidance/Air.h>

#include "avoidance/flights/Words.h"

namespace hagen::avoidance {

std::string nameOf(Air air) { return kAirs[static_cast<std::size_t>(air)]; }

Air airFrom(const std::string& name) {
    try {
        return wordFrom<Air>(name, kAirs);
    } catch (const std::runtime_error& e) {
        throw std::invalid_argument(std::string("air: ") + e.what());
    }
}

simulation::SensorErrorModel trialErrorModel(Air air) {
    simulation::SensorErrorModel faults;
    faults.least_noise_m = 0.02;
    faults.lost = 0.01;
    if (air == Air::Dusty) return faults;
    faults.mixed = 0;
    faults.dust_per_m = 0;
    faults.airframe = false;
    return faults;
}

Airframe trialAirframe(Air air) {
    Airframe airframe;
    if (air == Air::Clear) return airframe;
    airframe.boxes = {{{0.10f, 0.11f, -0.44f}, {0.38f, 0.38f, 0.00f}},
                      {{-0.39f, 0.11f, -0.46f}, {-0.11f, 0.39f, 0.00f}},
                      {{0.10f, -0.37f, -0.43f}, {0.37f, -0.10f, 0.00f}},
                      {{-0.41f, -0.39f, -0.47f}, {-0.12f, -0.11f, 0.00f}},
                      {{-0.08f, 0.28f, 0.03f}, {0.08f, 0.74f, 0.64f}}};
    airframe.spheres = {{{-0.23f, 0.02f, 0.14f}, 0.22f}};
    return airframe;
}

}  // namespace hagen::avoidance
