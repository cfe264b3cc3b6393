// The section `airframe:` of settings files.
#pragma once
#include <yaml-cpp/yaml.h>

#include <hagen/settings/Settings.h>
#include <filesystem>
#include <string>

namespace hagen {

/// Reads the list of parts, and the file of learned bins that it names, relative to `file`; that of
/// a recording's settings must be in their own folder. Throws SettingsError naming file, line, key
/// and what is allowed.
Settings::AirframeMask parseAirframe(const std::filesystem::path& file, const YAML::Node& section,
                                     SettingsOrigin origin);

/// Returns the section as text; reading it returns the same parts.
std::string airframeText(const Settings::AirframeMask& mask);

}  // namespace hagen
