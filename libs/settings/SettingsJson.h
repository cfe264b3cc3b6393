#pragma once
#include <hagen/settings/Settings.h>

#include <nlohmann/json_fwd.hpp>

namespace hagen {

/// Settings for reports of the programs: each option by its key, then the sensor's model, limits
/// and mount, and the number of parts of the airframe. No number in JSON is infinite: ".inf" is a
/// text. What is not set is null.
nlohmann::ordered_json jsonOf(const Settings& settings);

}  // namespace hagen
