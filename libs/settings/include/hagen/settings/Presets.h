#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hagen {

/// Returns the folders that are searched for presets, highest precedence first: those in the
/// environment variable HAGEN_CONFIG_PATH (separated by colons), those of addPresetFolder(),
/// `../share/hagen/config` relative to the running program, and the installed folder. Some may not
/// exist.
std::vector<std::filesystem::path> presetFolders();

/// Adds a preset folder for the rest of the process. For libraries with their own presets.
void addPresetFolder(const std::filesystem::path& folder);

/// Returns the sorted names of all presets for which `isUsable` returns true.
std::vector<std::string> presetNames(
    const std::function<bool(const std::filesystem::path&)>& isUsable);

/// Returns the file of a preset, such as `vlp16` or `vlp16.yaml`; empty if there is no such preset.
std::filesystem::path findPreset(const std::string& name);

/// True if mergeSettings() accepts the file.
bool isSettingsFile(const std::filesystem::path& file);

/// Returns the settings file for an argument of `-c`: `name` itself if it is an existing path,
/// otherwise the preset with this name. If neither exists, throws SettingsError listing the
/// searched folders and the presets for which `isUsable` returns true.
std::filesystem::path presetFile(
    const std::string& name,
    const std::function<bool(const std::filesystem::path&)>& isUsable = isSettingsFile);

}  // namespace hagen
