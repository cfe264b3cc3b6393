#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "Summary.h"

namespace hagen {

/// All of a summary; what is NaN is null.
nlohmann::ordered_json jsonOf(const Summary& summary);

/// A row a cell.
std::string csvOf(const Summary& summary);

}  // namespace hagen
