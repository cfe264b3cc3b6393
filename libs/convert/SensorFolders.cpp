#include "convert/SensorFolders.h"
#include "base/Folder.h"
#include "base/WriteFile.h"

#include <cctype>

namespace hagen::convert {
namespace {

namespace fs = std::filesystem;

/// The file name for a sensor label. Leaves room for suffixes of equal names, within the 255-byte
/// limit of file systems.
std::string fileName(const std::string& sensor_label) {
    constexpr std::size_t kMaxLetters = 100;
    std::string name = sensor_label.substr(0, kMaxLetters);
    for (char& c : name) {
        const bool is_plain =
            std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
        if (!is_plain) c = '_';
    }
    return name.empty() || name[0] == '.' ? "_" + name : name;
}

}  // namespace

SensorFolders::SensorFolders(const fs::path& folder, const base::OutputKind& kind, bool overwrite)
    : marker_(kind.marker), path_(folder, kind, overwrite) {
    fs::create_directory(path_.temporary());
}

const fs::path& SensorFolders::folderOf(const std::string& sensor_label) {
    fs::path& folder = folders_[sensor_label];
    if (folder.empty()) {
        std::string name = fileName(sensor_label);
        if (marker_ != nullptr && name == marker_) name += "_";
        folder = path_.temporary() / name;
        while (!fs::create_directory(folder)) folder += "_";  // name already taken
    }
    return folder;
}

/// If there is only one sensor, makes its folder the whole output.
void SensorFolders::unwrapOnlyFolder() {
    if (folders_.size() != 1 || is_unwrapped_) return;
    const fs::path only = folders_.begin()->second;
    fs::path lifted = path_.temporary();
    lifted += ".one";
    fs::rename(only, lifted);
    try {
        fs::remove(path_.temporary());
        fs::rename(lifted, path_.temporary());
    } catch (const fs::filesystem_error&) {  // restores the folder for keepPartial()
        std::error_code ignored;
        fs::create_directory(path_.temporary(), ignored);
        fs::rename(lifted, only, ignored);
        throw;
    }
    is_unwrapped_ = true;
}

void SensorFolders::commit() {
    if (folders_.empty()) return;
    unwrapOnlyFolder();
    writeMarker();
    path_.commit();
}

void SensorFolders::writeMarker() const {
    if (marker_ == nullptr) return;
    base::writeText("Made by rawlog-segment, which may replace this folder.\n",
                    path_.temporary() / marker_, path_.path() / marker_);
}

fs::path SensorFolders::keepPartial() {
    unwrapOnlyFolder();
    writeMarker();
    return path_.keepPartial();
}

}  // namespace hagen::convert
