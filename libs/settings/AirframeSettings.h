// Parses the section `airframe:` of settings files.
#pragma once
#include <yaml-cpp/yaml.h>

#include <hagen/settings/Settings.h>
#include <filesystem>
#include <string>

namespace hagen {

/// Reads the list of parts and the file of learned bins named in it, relative to `file`; for a
/// recording's settings, that file must be in the same folder. Throws SettingsError naming the
/// file, line, key and allowed values.
Settings::AirframeMask parseAirframe(const std::filesystem::path& file, const YAML::Node& section,
                                     SettingsOrigin origin);

/// Returns the section as text. parseAirframe() reads the same parts from it.
std::string airframeText(const Settings::AirframeMask& mask);

}  // namespace hagen
