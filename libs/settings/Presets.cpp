#include <hagen/settings/Presets.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>

#include <hagen/settings/Settings.h>
#include "base/Folder.h"
#include "base/Text.h"
#include "settings/YamlParts.h"

namespace hagen {

namespace fs = std::filesystem;

namespace {

const char* const kVariable = "HAGEN_CONFIG_PATH";

/// The folder `../share/hagen/config` relative to the running program, for relocated installations
/// and for builds (which link it to config/). Empty if the program's path is unknown.
fs::path folderOfProgram() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (error || !program.has_parent_path()) return {};
    return program.parent_path().parent_path() / "share/hagen/config";
}

/// True if a name has no folder, so that it may be a preset's name.
bool isPlain(const fs::path& name) { return !name.has_parent_path() && !name.stem().empty(); }

/// The name of a preset, without the file extension.
std::string presetName(const fs::path& name) {
    return (name.extension() == ".yaml" ? name.stem() : name).string();
}

std::string searchedFolders() {
    std::vector<std::string> folders;
    for (const fs::path& folder : presetFolders()) {
        std::error_code error;
        const bool exists = fs::is_directory(folder, error);
        folders.push_back(folder.string() + (exists ? "" : " (no such folder)"));
    }
    return base::joined(folders);
}

struct AddedFolders {
    std::mutex mutex;
    std::vector<fs::path> folders;
};
AddedFolders& added() {
    static AddedFolders folders;
    return folders;
}

}  // namespace

void addPresetFolder(const fs::path& folder) {
    const std::lock_guard lock(added().mutex);
    added().folders.push_back(folder);
}

std::vector<fs::path> presetFolders() {
    std::vector<fs::path> folders;
    const auto add = [&](const fs::path& folder) {
        if (folder.empty()) return;
        const fs::path normal = folder.lexically_normal();
        if (std::find(folders.begin(), folders.end(), normal) == folders.end()) {
            folders.push_back(normal);
        }
    };
    if (const char* const given = std::getenv(kVariable); given != nullptr) {
        std::istringstream list(given);
        for (std::string folder; std::getline(list, folder, ':');) add(folder);
    }
    {
        const std::lock_guard lock(added().mutex);
        for (const fs::path& folder : added().folders) add(folder);
    }
    add(folderOfProgram());
    add(HAGEN_INSTALLED_CONFIG);
    return folders;
}

std::vector<std::string> presetNames(const std::function<bool(const fs::path&)>& isUsable) {
    std::set<std::string> seen, names;
    for (const fs::path& folder : presetFolders()) {
        std::error_code error;
        for (const fs::path& file : base::entriesOf(folder, error)) {
            if (file.extension() != ".yaml" || !fs::is_regular_file(file, error)) continue;
            // Files in earlier folders take precedence over files of the same name.
            const std::string name = file.stem().string();
            if (seen.insert(name).second && isUsable(file)) names.insert(name);
        }
    }
    return {names.begin(), names.end()};
}

bool isSettingsFile(const fs::path& file) {
    try {
        Settings ignored;
        mergeSettings(file, ignored);
        return true;
    } catch (const std::runtime_error&) {
        return false;
    }
}

fs::path findPreset(const std::string& name) {
    if (!isPlain(name)) return {};
    for (const fs::path& folder : presetFolders()) {
        const fs::path file = folder / (presetName(name) + ".yaml");
        std::error_code error;
        if (fs::is_regular_file(file, error)) return file;
    }
    return {};
}

fs::path presetFile(const std::string& name, const std::function<bool(const fs::path&)>& isUsable) {
    std::error_code error;
    const bool exists = fs::exists(name, error);
    // Prefer a preset to a folder of the same name.
    if (exists && !fs::is_directory(name, error)) return name;
    if (const fs::path preset = findPreset(name); !preset.empty()) return preset;
    if (exists) return name;
    if (name.find('=') != std::string::npos) {
        throw SettingsError(name + ": no such file or preset; to set a key: --set " + name);
    }
    const std::string preset = presetName(fs::path(name).filename());
    if (!findPreset(preset).empty()) {  // probably a path from a guide
        throw SettingsError(name + ": no such file; the preset's name is '" + preset + "'");
    }
    if (!isPlain(name)) throw SettingsError(name + ": no such file");

    const std::vector<std::string> known = presetNames(isUsable);
    throw SettingsError(name + ": no such file or preset" + base::didYouMean(preset, known) +
                        " (presets: " + (known.empty() ? "none" : base::joined(known)) +
                        "; searched: " + searchedFolders() + "; " + kVariable + " adds folders)");
}

}  // namespace hagen
