#pragma once
#include <hagen/settings/Settings.h>

namespace hagen::base {
class Json;
}

namespace hagen {

/// Settings for reports of the programs: each option by its key, then the sensor's model, limits
/// and mount, and the number of parts of the airframe. No number in JSON is infinite: ".inf" is a
/// text. What is not set is null.
base::Json jsonOf(const Settings& settings);

}  // namespace hagen
