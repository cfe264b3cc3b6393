#include <unistd.h>

#include <hagen/observations/OutputPath.h>
#include <array>
#include <stdexcept>
#include <string>

namespace hagen {
namespace {

namespace fs = std::filesystem;

/// All that a scan folder holds; one with anything else in it is somebody's work.
bool isPartOfScanFolder(const std::string& name) {
    static const std::array<const char*, 5> kParts{"velodyne", "labels", "times.txt", "poses.txt",
                                                   "sensor.yaml"};
    for (const char* part : kParts) {
        if (name == part) return true;
    }
    return false;
}

void checkReplaceable(const fs::path& path, OutputPath::Kind kind) {
    if (kind == OutputPath::Kind::File) {
        if (!fs::is_regular_file(path)) {
            throw std::runtime_error(path.string() +
                                     ": is no file, and is not replaced; give another name");
        }
        return;
    }
    if (!fs::is_directory(path)) {
        throw std::runtime_error(path.string() +
                                 ": is no folder, and is not replaced; give another name");
    }
    for (const auto& entry : fs::directory_iterator(path)) {
        const std::string name = entry.path().filename().string();
        if (!isPartOfScanFolder(name)) {
            throw std::runtime_error(path.string() + ": holds '" + name +
                                     "', no part of a scan folder, and is not replaced; give "
                                     "another name");
        }
    }
}

/// `stem` `mark` `extension`, or with a number behind the mark: the first that nothing has.
fs::path freeName(const fs::path& stem, const std::string& mark, const fs::path& extension) {
    for (int number = 1;; ++number) {
        fs::path name = stem;
        name += mark + (number == 1 ? "" : "-" + std::to_string(number));
        name += extension;
        if (!fs::exists(fs::symlink_status(name))) return name;
    }
}

}  // namespace

OutputPath::OutputPath(fs::path path, Kind kind, bool overwrite) : path_(std::move(path)) {
    if (!path_.has_filename()) path_ = path_.parent_path();  // "folder/"
    if (fs::exists(path_)) {
        if (!overwrite) {
            throw std::runtime_error(path_.string() + " exists; give --overwrite to replace it");
        }
        checkReplaceable(path_, kind);
    }
    const fs::path folder = fs::absolute(path_).lexically_normal().parent_path();
    if (!fs::is_directory(folder)) {
        throw std::runtime_error(folder.string() + ": no such folder to write to");
    }
    temporary_ = freeName(path_, ".tmp-" + std::to_string(getpid()), "");
}

OutputPath::~OutputPath() {
    std::error_code ignored;  // a destructor has nobody to tell
    fs::remove_all(temporary_, ignored);
}

void OutputPath::commit() {
    if (!fs::is_directory(path_)) {
        fs::rename(temporary_, path_);
        return;
    }
    // rename() does not replace a folder with something in it.
    const fs::path old = freeName(path_, ".old-" + std::to_string(getpid()), "");
    fs::rename(path_, old);
    fs::rename(temporary_, path_);
    fs::remove_all(old);
}

fs::path OutputPath::keepPartial() {
    const bool is_folder = fs::is_directory(temporary_);
    fs::path stem = path_;
    if (!is_folder) stem.replace_extension();
    const fs::path name = freeName(stem, ".partial", is_folder ? fs::path() : path_.extension());
    fs::rename(temporary_, name);
    return name;
}

}  // namespace hagen
