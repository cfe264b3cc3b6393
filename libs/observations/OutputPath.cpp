#include <hagen/observations/OutputPath.h>
#include <stdexcept>

namespace hagen {

namespace fs = std::filesystem;

OutputPath::OutputPath(fs::path path, bool overwrite) : path_(std::move(path)) {
    if (!path_.has_filename()) path_ = path_.parent_path();  // "folder/"
    if (fs::exists(path_) && !overwrite) {
        throw std::runtime_error(path_.string() + " exists; give --overwrite to replace it");
    }
    const fs::path folder = fs::absolute(path_).parent_path();
    if (!fs::is_directory(folder)) {
        throw std::runtime_error(folder.string() + ": no such folder to write to");
    }
    temporary_ = path_;
    temporary_ += ".tmp";
    fs::remove_all(temporary_);
}

OutputPath::~OutputPath() {
    std::error_code ignored;  // a destructor has nobody to tell
    fs::remove_all(temporary_, ignored);
}

fs::path OutputPath::keepPartial() {
    fs::path name = path_;
    name.replace_extension();
    name += ".partial";
    name += path_.extension();
    moveTo(name);
    return name;
}

void OutputPath::moveTo(const fs::path& name) {
    if (fs::is_directory(name)) {  // rename() does not replace a folder with something in it
        fs::path old = name;
        old += ".old";
        fs::remove_all(old);
        fs::rename(name, old);
        fs::rename(temporary_, name);
        fs::remove_all(old);
    } else {
        fs::rename(temporary_, name);
    }
}

}  // namespace hagen
