#include "settings/SettingsJson.h"

#include "base/Json.h"
#include "base/NumberText.h"
#include "filter/OptionKeys.h"

#include <cmath>

namespace hagen {
namespace {

using base::Json;

Json option(const OptionKey& key, const Options& options) {
    const std::string text = textOf(key, options);
    const auto* number = std::get_if<float Options::*>(&key.field);
    const bool is_infinite = number != nullptr && !std::isfinite(options.*(*number));
    const bool is_word = std::holds_alternative<Seeds Options::*>(key.field);
    return is_word || is_infinite ? Json(text) : Json::parse(text);
}

/// A limit with as many digits as in settings files.
Json limit(const std::optional<float>& value) {
    return value ? Json::parse(base::shortestText(*value)) : Json();
}

}  // namespace

Json jsonOf(const Settings& settings) {
    Json json;
    for (const OptionKey& key : optionKeys()) json[key.name] = option(key, settings.options);
    const Settings::Sensor& sensor = settings.sensor;
    json["sensor.model"] = sensor.model ? Json(*sensor.model) : Json();
    if (!sensor.elevations_deg.empty()) json["sensor.elevations_deg"] = sensor.elevations_deg;
    json["sensor.min_range_m"] = limit(sensor.min_range_m);
    json["sensor.max_range_m"] = limit(sensor.max_range_m);
    json["sensor.mount_roll_deg"] = Json::parse(degreesText(settings.mount.roll_rad));
    json["sensor.mount_pitch_deg"] = Json::parse(degreesText(settings.mount.pitch_rad));
    const Settings::AirframeMask& airframe = settings.airframe;
    json["airframe"] = {
        {"boxes", airframe.parts.boxes.size()},
        {"spheres", airframe.parts.spheres.size()},
        {"learned", airframe.learned.empty() ? Json() : Json(airframe.learned.string())}};
    return json;
}

}  // namespace hagen
