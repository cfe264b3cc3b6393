#pragma once
#include <hagen/reports/Summary.h>
#include <nlohmann/json.hpp>

namespace hagen::reports {

/// All of a summary; what is NaN is null.
nlohmann::ordered_json jsonOf(const Summary& summary);

}  // namespace hagen::reports
