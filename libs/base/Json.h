#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace hagen::base {

/// Keeps its keys in insertion order, for reports.
using Json = nlohmann::ordered_json;

/// Parses the text of a file. Throws std::runtime_error with line and column if it is not valid
/// JSON, or is nested more than 64 levels deep.
nlohmann::json parseJson(const std::string& text);

/// JSON on one line, or indented by this number of spaces. Bytes that are not UTF-8, as in file
/// names, become U+FFFD.
std::string dumpJson(const Json& json, int indent = -1);

}  // namespace hagen::base
