#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <hagen/base/OutputPath.h>
#include <algorithm>
#include <cstdio>
#include <random>
#include <regex>
#include "base/Folder.h"
#include "base/ReadFile.h"
#include "base/Text.h"
#include "base/WriteFile.h"

namespace hagen::base {
namespace {

namespace fs = std::filesystem;

fs::path withoutSlash(const fs::path& path) {
    return path.has_filename() ? path : path.parent_path();
}

fs::path parentOf(const fs::path& path) {
    return fs::absolute(path).lexically_normal().parent_path();
}

/// True if `inner` is `outer` or is inside it.
bool isWithin(const fs::path& inner, const fs::path& outer) {
    const fs::path below = withoutSlash(fs::weakly_canonical(fs::absolute(inner)));
    const fs::path above = withoutSlash(fs::weakly_canonical(fs::absolute(outer)));
    return std::mismatch(above.begin(), above.end(), below.begin(), below.end()).first ==
           above.end();
}

/// The first file in a folder that is not part of an output of this kind, searching `depth` folders
/// deep; empty if there is none.
fs::path foreignPart(const fs::path& folder, const fs::path& output, const OutputKind& kind,
                     int depth) {
    for (const fs::path& entry : entriesOf(folder)) {
        const fs::file_status status = fs::symlink_status(entry);
        if (fs::is_regular_file(status) && kind.holds(entry.lexically_relative(output))) continue;
        if (depth == 0 || !fs::is_directory(status)) return entry;
        fs::path foreign = foreignPart(entry, output, kind, depth - 1);
        if (!foreign.empty()) return foreign;
    }
    return {};
}

/// True if the path is a mount point, such as a container's volume. Mount points cannot be renamed.
bool isMountPoint(const fs::path& path) {
    struct statx own {};
    return statx(AT_FDCWD, path.c_str(), AT_SYMLINK_NOFOLLOW, 0, &own) == 0 &&
           (own.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
}

void checkReplaceable(const fs::path& path, const OutputKind& kind) {
    const auto refuse = [&](const std::string& what) {
        failAt(path, what + ", so it is not replaced; choose another name");
    };
    const bool is_file = kind.holds == nullptr;
    if (fs::is_symlink(path)) refuse("is a symbolic link");  // for example /dev/stdout
    if (is_file && !fs::is_regular_file(path)) refuse("not a file");
    if (!is_file && !fs::is_directory(path)) refuse("not a folder");
    if (isMountPoint(path)) refuse("is a mount point");
    if (is_file || entriesOf(path).empty()) return;
    if (kind.marker != nullptr && !fs::exists(path / kind.marker)) {
        refuse(std::string("has no '") + kind.marker + "' and is not " + kind.what +
               " of an earlier run");
    }
    const fs::path foreign = foreignPart(path, path, kind, 2);
    if (!foreign.empty()) {
        refuse("contains '" + foreign.lexically_relative(path).string() +
               "', which is not part of " + kind.what);
    }
    if (kind.is_made != nullptr && !kind.is_made(path)) {
        refuse(std::string("is not ") + kind.what + " of an earlier run");
    }
}

/// A hidden name beside `path` with the process ID and 64 random bits. In a folder that others may
/// write to, an attacker could place a link at a predictable name.
fs::path secretName(const fs::path& path, const std::string& mark) {
    std::random_device random;
    char bits[20];
    std::snprintf(bits, sizeof bits, "-%08x%08x", random(), random());
    return path.string() + mark + std::to_string(getpid()) + bits;
}

/// Flushes a file, or a folder with all its files, to the disk, so that a power failure cannot lose
/// both the old and the new data. Accepts file systems that cannot flush (EINVAL).
void flushToDisk(const fs::path& path, const fs::path& named) {
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0 && errno == EACCES) return;  // a file without read permission is not flushed
    if (descriptor < 0) throwWriteError(named, errno);
    const int result = fs::is_directory(path) ? syncfs(descriptor) : fsync(descriptor);
    const int error = result == 0 ? 0 : errno;
    close(descriptor);
    if (error != 0 && error != EINVAL) throwWriteError(named, error);
}

}  // namespace

OutputPath::OutputPath(fs::path path, const OutputKind& kind, bool overwrite)
    : path_(std::move(path)), kind_(kind), overwrites_(overwrite) {
    if (!path_.has_filename() && kind_.holds == nullptr) {
        failAt(path_, "ends with '/', but the output is a file");
    }
    path_ = withoutSlash(path_);
    checkFree();
    const fs::path folder = parentOf(path_);
    std::error_code error;
    for (fs::path missing = folder; !fs::exists(missing, error); missing = missing.parent_path()) {
        created_.push_back(missing);
    }
    fs::create_directories(folder, error);
    if (error) failAt(folder, "cannot be created: " + error.message());
    temporary_ = secretName(path_, ".tmp-");
}

OutputPath::~OutputPath() {
    std::error_code not_empty;
    fs::remove_all(temporary_, not_empty);
    for (const fs::path& folder : created_) fs::remove(folder, not_empty);
}

void OutputPath::checkFree() const {
    if (!fs::exists(fs::symlink_status(path_))) return;
    if (!overwrites_) {
        throw std::runtime_error(path_.string() + " exists; use --overwrite to replace it");
    }
    checkReplaceable(path_, kind_);
}

/// Returns false if the name is already taken.
bool OutputPath::renameToFreeName(const fs::path& name) const {
    if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, name.c_str(), RENAME_NOREPLACE) == 0) {
        return true;
    }
    if (errno == EEXIST || fs::exists(fs::symlink_status(name))) return false;
    fs::rename(temporary_, name);  // the file system does not support RENAME_NOREPLACE
    return true;
}

void OutputPath::commit() {
    flushToDisk(temporary_, path_);
    std::string taken;  // why the path is not free
    try {
        checkFree();
        if (!overwrites_ && !renameToFreeName(path_))
            taken = path_.string() + " was created in the meantime";
    } catch (const fs::filesystem_error&) {
        throw;
    } catch (const std::runtime_error& e) {
        taken = e.what();
    }
    if (!taken.empty()) {
        throw std::runtime_error(taken + "; this run's output was saved as " +
                                 keepPartial().string());
    }
    const fs::path old = overwrites_ ? replace() : fs::path();
    kept_ = path_;
    flushToDisk(parentOf(path_), path_);
    if (old.empty()) return;
    std::error_code error;
    fs::remove_all(old, error);
    if (error) {
        failAt(path_, "is complete, but the previous output beside it cannot be removed: " +
                          error.message());
    }
}

/// Renames the output into place. Returns the new path of the replaced folder; empty if none.
fs::path OutputPath::replace() const {
    if (!fs::is_directory(temporary_) || !fs::is_directory(path_)) {
        std::error_code error;
        fs::rename(temporary_, path_, error);
        if (error)
            failAt(path_, "cannot be replaced: " + error.message() + "; choose another name");
        return {};
    }
    // rename() cannot replace a non-empty folder, but an exchange is atomic.
    if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, path_.c_str(), RENAME_EXCHANGE) == 0) {
        return temporary_;
    }
    // Some file systems do not support exchange.
    const fs::path old = secretName(path_, ".old-");
    fs::rename(path_, old);
    try {
        fs::rename(temporary_, path_);
    } catch (const fs::filesystem_error&) {
        fs::rename(old, path_);
        throw;
    }
    return old;
}

fs::path OutputPath::keepPartial() {
    if (!kept_.empty()) return kept_;
    const bool is_folder = fs::is_directory(temporary_);
    fs::path stem = path_;
    if (!is_folder) stem.replace_extension();
    for (int number = 1;; ++number) {
        fs::path name = stem;
        name += number == 1 ? ".partial" : ".partial-" + std::to_string(number);
        if (!is_folder) name += path_.extension();
        if (renameToFreeName(name)) return kept_ = name;
    }
}

std::string withOutputNames(const std::string& message) {
    static const std::regex mark("\\.tmp-" + std::to_string(getpid()) + "-[0-9a-f]{16}");
    return std::regex_replace(message, mark, "");
}

std::vector<fs::path> partialOutputs(const fs::path& output) {
    std::vector<fs::path> found;
    if (output.empty()) return found;
    const fs::path path = withoutSlash(output);
    const bool is_folder = fs::is_directory(path);
    const std::string stem = (is_folder ? path.filename() : path.stem()).string();
    const std::string extension = is_folder ? "" : path.extension().string();
    std::error_code unreadable;
    for (const fs::path& entry : entriesOf(parentOf(path), unreadable)) {
        const std::string name = entry.filename().string();
        if (name.rfind(stem + ".partial", 0) != 0) continue;
        if (is_folder || entry.extension() == extension) found.push_back(path.parent_path() / name);
    }
    return found;
}

void checkApart(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs,
                const std::string& role) {
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        if (output->empty()) continue;
        for (const fs::path& input : inputs) {
            if (input.empty()) continue;
            if (isWithin(input, *output)) {
                failAt(*output, "is or contains " + role + "; choose another output");
            }
            if (fs::exists(*output) && isWithin(*output, input)) {
                failAt(*output, "is in " + role + " " + input.string() +
                                    " and may be part of it, so it is not replaced; choose "
                                    "another output");
            }
        }
        for (auto other = output + 1; other != outputs.end(); ++other) {
            if (other->empty()) continue;
            if (!isWithin(*output, *other) && !isWithin(*other, *output)) continue;
            failAt(output->string() + " and " + other->string(),
                   "one output is inside the other; use separate paths");
        }
    }
}

}  // namespace hagen::base
