#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hagen {

/// Returns the folders that are searched for presets, first the one that wins: those of the
/// environment variable HAGEN_CONFIG_PATH (separated by colons), those of addPresetFolder(),
/// `../share/hagen/config` relative to the running program, and that of the installation. They need
/// not exist.
std::vector<std::filesystem::path> presetFolders();

/// Adds a folder to these, for the rest of the process: for a library that brings its own presets.
void addPresetFolder(const std::filesystem::path& folder);

/// Returns the names of the presets in presetFolders(), sorted, of those files for which
/// `isUsable` returns true.
std::vector<std::string> presetNames(
    const std::function<bool(const std::filesystem::path&)>& isUsable);

/// Returns the file of a preset such as `vlp16` or `vlp16.yaml`; empty if there is none.
std::filesystem::path findPreset(const std::string& name);

/// Whether mergeSettings() accepts a file.
bool isSettingsFile(const std::filesystem::path& file);

/// Returns the file that a flag such as `-c` names: `name` itself if it is an existing path,
/// otherwise the preset of findPreset(). Throws SettingsError if there is neither.
/// It lists the presets for which `isUsable` returns true, and the folders that were searched.
std::filesystem::path presetFile(
    const std::string& name,
    const std::function<bool(const std::filesystem::path&)>& isUsable = isSettingsFile);

}  // namespace hagen
