#pragma once
#include <hagen/settings/Settings.h>

#include <nlohmann/json_fwd.hpp>

namespace hagen {

/// Settings for reports: each option by its key, then the sensor's model, limits and mount, and the
/// number of airframe parts. Infinity becomes the text ".inf", and an unset value null.
nlohmann::ordered_json jsonOf(const Settings& settings);

}  // namespace hagen
