#pragma once
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <functional>
#include <string>

namespace hagen::evaluation {

/// Calls `entry(key, key node, value node)` for each entry of the map in a file. Throws
/// std::runtime_error naming file and line if the file cannot be read, is not YAML, contains no
/// map, or contains a key twice. Exceptions of `entry` are rethrown with the place of the value
/// prepended.
void forEachYamlEntry(
    const std::filesystem::path& file, const std::string& example,
    const std::function<void(const std::string& key, const YAML::Node& value)>& entry);

}  // namespace hagen::evaluation
