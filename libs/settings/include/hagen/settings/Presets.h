#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hagen {

/// Returns the folders that are searched for presets, highest precedence first: those of the
/// environment variable HAGEN_CONFIG_PATH (separated by colons), those of addPresetFolder(),
/// `../share/hagen/config` relative to the running program, and the installation's. They need not
/// exist.
std::vector<std::filesystem::path> presetFolders();

/// Adds a preset folder for the rest of the process, for libraries with their own presets.
void addPresetFolder(const std::filesystem::path& folder);

/// Returns the sorted names of the presets in presetFolders() for which `isUsable` returns true.
std::vector<std::string> presetNames(
    const std::function<bool(const std::filesystem::path&)>& isUsable);

/// Returns the file of a preset such as `vlp16` or `vlp16.yaml`; empty if there is none.
std::filesystem::path findPreset(const std::string& name);

/// True if mergeSettings() accepts a file.
bool isSettingsFile(const std::filesystem::path& file);

/// Returns the file that a flag such as `-c` names: `name` itself if it is an existing path,
/// otherwise the preset of findPreset(). If neither exists, throws SettingsError listing the
/// presets for which `isUsable` returns true, and the searched folders.
std::filesystem::path presetFile(
    const std::string& name,
    const std::function<bool(const std::filesystem::path&)>& isUsable = isSettingsFile);

}  // namespace hagen
