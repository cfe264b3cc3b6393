#pragma once
#include <map>
#include <string>
#include <string_view>

namespace hagen::pages {

/// A page with each {{name}} replaced. Throws std::logic_error for a name without a value.
std::string filled(std::string_view page, const std::map<std::string, std::string_view>& values);

/// JSON as it may stand in a script element.
std::string scriptText(std::string json);

}  // namespace hagen::pages
