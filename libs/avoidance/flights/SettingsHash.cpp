#include "avoidance/flights/SettingsHash.h"
#include <hagen/avoidance/Vehicle.h>
#include <hagen/avoidance/WindowSize.h>
#include <hagen/filter/Options.h>
#include "avoidance/flights/TrialSensor.h"
#include "base/Json.h"
#include "filter/OptionKeys.h"

#include <array>
#include <cstdint>
#include <cstdio>

namespace hagen::avoidance {
namespace {

/// The 64-bit Fowler-Noll-Vo hash FNV-1a in hexadecimal.
std::string hashOf(const std::string& text) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : text) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    }
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
    return digits.data();
}

/// The filter's default options, one "key=value" per line, without descriptions, which do not
/// affect runs.
std::string filterText() {
    std::string text;
    const Options options;
    for (const OptionKey& key : optionKeys()) text += key.name + "=" + textOf(key, options) + "\n";
    return text;
}

/// Ranges of the models, as text.
std::string reachText() {
    std::string text;
    for (const double speed_m_s : {1, 4, 8, 10, 14, 100}) {
        const FlightPace pace{speed_m_s, TrialSensor::kTurn_s, {}};
        text += std::to_string(windowSizeFor(pace).radius_m) + " " +
                std::to_string(perceptionRangeFor_m(pace)) + "\n";
    }
    return text;
}

/// Vehicle parameters as JSON.
std::string vehicleText() {
    const VehicleLimits limits;
    return base::Json{{"acceleration_m_s2", limits.acceleration_m_s2},
                      {"actuation_delay_s", limits.actuation_delay_s},
                      {"radius_m", limits.radius_m},
                      {"margin_m", limits.margin_m},
                      {"collision_m", limits.collision_m},
                      {"response_per_s", limits.response_per_s}}
        .dump();
}

/// The LiDAR's errors by air, as JSON.
std::string sensorText() {
    base::Json airs;
    for (const Air air : {Air::Dusty, Air::Clear}) {
        const simulation::SensorErrorModel faults = trialErrorModel(air);
        airs[nameOf(air)] = {{"footprint_rad", faults.footprint_rad},
                             {"least_noise_m", faults.min_noise_m},
                             {"half_range_m", faults.half_range_m},
                             {"lost", faults.lost},
                             {"mixed", faults.mixed},
                             {"dust_per_m", faults.dust_per_m},
                             {"airframe", faults.airframe}};
    }
    return airs.dump();
}

}  // namespace

std::string hashOfSettings(const LatencyProfile& profile) {
    return hashOf(std::string(HAGEN_VERSION) + "\n" + std::to_string(kRevision) + "\n" +
                  vehicleText() + "\n" + sensorText() + "\n" + filterText() + reachText() +
                  textOf(profile));
}

}  // namespace hagen::avoidance
