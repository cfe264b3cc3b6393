// YAML parsing for settings files, with file and line in error messages.
#pragma once
#include <yaml-cpp/yaml.h>

#include <hagen/settings/Settings.h>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <type_traits>
#include <vector>
#include "base/NumberText.h"
#include "base/ReadFile.h"

namespace hagen {

/// The location of a value in a file, for messages.
std::string at(const std::filesystem::path& file, const YAML::Node& node);

/// The message for an unknown key, with the most similar known key.
std::string unknownKey(const std::string& key, const std::vector<std::string>& known);

/// Calls visit(key, value, location of the key for messages) for each entry of a map. Throws
/// SettingsError if `map` is not a map (quoting `example`) or if a key occurs twice.
template <class Visit>
void forEachKey(const std::filesystem::path& file, const YAML::Node& map,
                const std::string& section, const std::string& example, Visit visit) {
    if (!map.IsMap()) {
        throw SettingsError(at(file, map) + section + " must contain keys, such as " + example);
    }
    std::set<std::string> seen;
    for (const auto& entry : map) {
        const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
        const std::string place = at(file, entry.first);
        if (!seen.insert(key).second) {
            throw SettingsError(place + "key '" + (section.empty() ? "" : section + ".") + key +
                                "' occurs twice");
        }
        visit(key, entry.second, place);
    }
}

/// Reads a file with one YAML document. Throws SettingsError naming the file and line.
YAML::Node parseFile(const std::filesystem::path& file,
                     std::size_t max_bytes = base::kMaxTextBytes);

/// Reads a number within [min, max]. Throws SettingsError with the allowed range otherwise.
template <class Number>
Number parseNumber(const YAML::Node& node, const std::string& key, double min, double max) {
    // Parses integers as real numbers, because YAML reads 010 as octal.
    double value = 0;
    const bool is_number = node.IsScalar() && YAML::convert<double>::decode(node, value);
    if (!is_number || (std::is_integral_v<Number> && value != std::floor(value))) {
        throw SettingsError(key + " must be a " + (std::is_integral_v<Number> ? "whole " : "") +
                            "number" + (node.IsScalar() ? ", not '" + node.Scalar() + "'" : ""));
    }
    if (!(value >= min && value <= max)) {  // true for NaN
        throw SettingsError(key + " is " + node.Scalar() + ", but must lie between " +
                            base::shortestText(min) + " and " + base::shortestText(max));
    }
    return static_cast<Number>(value);
}

}  // namespace hagen
