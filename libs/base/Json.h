#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace hagen::base {

/// JSON for reports, with keys in insertion order.
using Json = nlohmann::ordered_json;

/// Parses the text of a file. Throws std::runtime_error with line and column if it is not valid
/// JSON, or is nested more than 64 levels deep.
nlohmann::json parseJson(const std::string& text);

/// JSON on one line, or indented by this number of spaces. Bytes that are not valid UTF-8 become
/// U+FFFD.
std::string dumpJson(const Json& json, int indent = -1);

}  // namespace hagen::base
