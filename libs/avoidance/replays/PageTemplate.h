#pragma once
#include <map>
#include <string>
#include <string_view>

namespace hagen::avoidance {

/// Returns the page with each {{name}} replaced. Throws std::logic_error for a name without value.
std::string filled(std::string_view page, const std::map<std::string, std::string_view>& values);

/// Escapes JSON for use in a script element.
std::string scriptText(std::string json);

}  // namespace hagen::avoidance
