#pragma once
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <functional>
#include <string>

namespace hagen::evaluation {

/// "file:line: ", for messages.
std::string yamlPlace(const std::filesystem::path& file, const YAML::Node& node);

/// Calls `entry(key, key node, value node)` for each entry of the map that a file holds. Throws
/// std::runtime_error, naming file and line, where it cannot be read, is not YAML, holds no map, or
/// a key twice; what `entry` throws goes on with the value's place before it.
void forEachYamlEntry(
    const std::filesystem::path& file, const std::string& example,
    const std::function<void(const std::string& key, const YAML::Node& value)>& entry);

}  // namespace hagen::evaluation
