#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <hagen/base/Folder.h>
#include <hagen/base/NumberText.h>
#include <hagen/base/OutputPath.h>
#include <hagen/base/WriteFile.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

namespace hagen::base {
namespace {

namespace fs = std::filesystem;

/// Returns the first file in a folder that does not belong to such an output, searching `depth`
/// folders deep; empty if there is none.
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

/// True if `inner` is `outer` or lies in it.
bool isWithin(const fs::path& inner, const fs::path& outer) {
    const auto resolved = [](const fs::path& path) {
        const fs::path whole = fs::weakly_canonical(fs::absolute(path));
        return whole.has_filename() ? whole : whole.parent_path();  // "folder/"
    };
    const fs::path below = resolved(inner), above = resolved(outer);
    return std::mismatch(above.begin(), above.end(), below.begin(), below.end()).first ==
           above.end();
}

/// An older folder is renamed, then removed.
void checkMovable(const fs::path& folder) {
    std::error_code removed;
    const fs::path here = fs::current_path(removed);
    if (!removed && isWithin(here, folder)) {
        throw std::runtime_error(folder.string() +
                                 ": the program runs in this folder, which cannot be replaced "
                                 "meanwhile; call it from another one, or choose another name");
    }
}

/// A name at which a file system, a folder or a file is mounted cannot be renamed.
void checkNotMounted(const fs::path& path, const char* advice) {
    struct statx own {};
    if (statx(AT_FDCWD, path.c_str(), AT_SYMLINK_NOFOLLOW, 0, &own) != 0) return;
    if ((own.stx_attributes & own.stx_attributes_mask & STATX_ATTR_MOUNT_ROOT) == 0) return;
    throw std::runtime_error(path.string() + ": is a mount point, so it is not replaced; " +
                             advice);
}

void checkReplaceable(const fs::path& path, const OutputKind& kind) {
    if (fs::is_symlink(path)) {  // such as /dev/stdout
        throw std::runtime_error(path.string() +
                                 ": a link, so it is not replaced; give the path of what it means");
    }
    if (kind.holds == nullptr) {
        if (!fs::is_regular_file(path)) {
            throw std::runtime_error(path.string() +
                                     ": not a file, so it is not replaced; choose another name");
        }
        checkNotMounted(path, "choose another name");
        return;
    }
    if (!fs::is_directory(path)) {
        throw std::runtime_error(path.string() +
                                 ": not a folder, so it is not replaced; choose another name");
    }
    checkMovable(path);
    checkNotMounted(path, "choose a name in it");
    if (kind.marker != nullptr && !entriesOf(path).empty() && !fs::exists(path / kind.marker)) {
        throw std::runtime_error(path.string() + ": has no '" + kind.marker + "', so it is not " +
                                 kind.what +
                                 " of an earlier run, and is not replaced; choose another name");
    }
    const fs::path foreign = foreignPart(path, path, kind, 2);
    if (!foreign.empty()) {
        throw std::runtime_error(path.string() + ": contains '" +
                                 foreign.lexically_relative(path).string() +
                                 "', which is not part of " + kind.what +
                                 ", so it is not replaced; choose another name");
    }
    if (kind.is_made != nullptr && !entriesOf(path).empty() && !kind.is_made(path)) {
        throw std::runtime_error(path.string() + ": is not " + kind.what +
                                 " of an earlier run, so it is not replaced; choose another name");
    }
}

/// Returns `stem` `mark` `extension`, with a number after the mark if needed: the first free name.
fs::path freeName(const fs::path& stem, const std::string& mark, const fs::path& extension) {
    for (int number = 1;; ++number) {
        fs::path name = stem;
        name += mark + (number == 1 ? "" : "-" + std::to_string(number));
        name += extension;
        if (!fs::exists(fs::symlink_status(name))) return name;
    }
}

constexpr const char* kTemporaryMark = ".tmp-";

/// An unused name next to `path` that contains this process and 64 random bits. In a folder that
/// others may write to, a name that can be known in advance could be a link laid there by them.
fs::path secretName(const fs::path& path, const std::string& mark) {
    std::random_device random;
    char bits[20];
    std::snprintf(bits, sizeof bits, "-%08x%08x", random(), random());
    return freeName(path, mark + std::to_string(getpid()) + bits, "");
}

/// Has data reach the disk, so that a name never stands for less than it did before a power cut.
/// File systems that cannot do so (EINVAL) are taken as they are.
void syncFile(const fs::path& file, const fs::path& named) {
    const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0 && errno == EACCES) return;  // its owner does not allow to read
    if (descriptor < 0) throwWriteError(named, errno);
    const int error = fsync(descriptor) == 0 ? 0 : errno;
    close(descriptor);
    if (error != 0 && error != EINVAL) throwWriteError(named, error);
}

/// The same for all of a folder at once.
void syncFolder(const fs::path& folder, const fs::path& named) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) throwWriteError(named, errno);
    const int error = syncfs(descriptor) == 0 ? 0 : errno;
    close(descriptor);
    if (error != 0) throwWriteError(named, error);
}

/// When a process began, in seconds since 1970; none if /proc does not tell.
std::optional<double> startOf_s(pid_t process) {
    std::ifstream in("/proc/" + std::to_string(process) + "/stat");
    std::string text;
    std::getline(in, text);
    const std::size_t name_end = text.rfind(')');  // the name may hold anything
    if (name_end == std::string::npos) return std::nullopt;
    std::istringstream fields(text.substr(name_end + 1));
    std::string field;
    for (int number = 3; number <= 22; ++number) fields >> field;  // proc(5)
    const auto ticks = numberFrom<double>(field);
    timespec now{}, up{};
    if (!ticks || clock_gettime(CLOCK_REALTIME, &now) != 0 ||
        clock_gettime(CLOCK_BOOTTIME, &up) != 0) {
        return std::nullopt;
    }
    const auto seconds = [](const timespec& time) {
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    };
    return seconds(now) - seconds(up) + *ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

/// Whether a process with this number runs that began before a file was written last: another one
/// may have got the number since.
bool mayWrite(pid_t process, const fs::path& file) {
    if (kill(process, 0) != 0 && errno == ESRCH) return false;
    const std::optional<double> start_s = startOf_s(process);
    struct stat written {};
    if (!start_s || stat(file.c_str(), &written) != 0) return true;
    constexpr double kRounding_s = 1;
    return *start_s <= static_cast<double>(written.st_mtim.tv_sec) + kRounding_s;
}

/// The outputs of this process that are being written: their names by temporary name.
class Living {
 public:
    void add(const fs::path& temporary, const fs::path& name) {
        const std::lock_guard lock(mutex_);
        names_.emplace(temporary.string(), name.string());
    }
    void remove(const fs::path& temporary) noexcept {
        const std::lock_guard lock(mutex_);
        names_.erase(temporary.native());  // takes no memory
    }
    bool has(const fs::path& file) const {
        const std::lock_guard lock(mutex_);
        return std::any_of(names_.begin(), names_.end(), [&](const auto& each) {
            return fs::path(each.first).filename() == file.filename();
        });
    }
    std::string named(std::string text) const {
        const std::lock_guard lock(mutex_);
        for (const auto& [temporary, name] : names_) {
            for (std::size_t at = text.find(temporary); at != std::string::npos;
                 at = text.find(temporary, at + name.size())) {
                text.replace(at, temporary.size(), name);
            }
        }
        return text;
    }

 private:
    mutable std::mutex mutex_;
    std::map<std::string, std::string> names_;
};

Living& living() {
    static Living all;
    return all;
}

/// Whether a temporary file is of a process that does not run any more.
bool isLeftBehind(const fs::path& file, const std::string& output) {
    if (living().has(file)) return false;
    const std::string name = file.filename().string();
    const std::string start = output + kTemporaryMark;
    if (name.rfind(start, 0) != 0) return false;
    const std::string process =
        name.substr(start.size(), name.find('-', start.size()) - start.size());
    if (process.empty() || process.find_first_not_of("0123456789") != std::string::npos)
        return false;
    if (process.size() >= 10) return false;
    // In a container each run may have the same number. Outputs of this one have their names by
    // now.
    const int number = std::stoi(process);
    return number == getpid() || !mayWrite(number, file);
}

}  // namespace

OutputPath::OutputPath(fs::path path, const OutputKind& kind, bool overwrite)
    : path_(std::move(path)), kind_(kind), overwrites_(overwrite) {
    if (!path_.has_filename()) {  // "folder/"
        if (kind_.holds == nullptr) {
            throw std::runtime_error(path_.string() +
                                     ": ends like the name of a folder, but will be a file; leave "
                                     "out the '/'");
        }
        path_ = path_.parent_path();
    }
    checkFree();
    const fs::path folder = fs::absolute(path_).lexically_normal().parent_path();
    if (!fs::is_directory(folder)) {
        throw std::runtime_error(folder.string() + ": no such folder to write to");
    }
    temporary_ = secretName(path_, kTemporaryMark);
    reserveForRemoval();
    living().add(temporary_, path_);
}

OutputPath::~OutputPath() {
    removeAll(temporary_);
    living().remove(temporary_);
}

void OutputPath::checkFree() const {
    if (!fs::exists(fs::symlink_status(path_))) return;
    if (!overwrites_) {
        throw std::runtime_error(path_.string() + " exists; use --overwrite to replace it");
    }
    checkReplaceable(path_, kind_);
}

/// False if the name is taken, by someone else since it was looked at.
bool OutputPath::renameToFreeName(const fs::path& name) const {
    if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, name.c_str(), RENAME_NOREPLACE) == 0) {
        return true;
    }
    if (errno == EEXIST) return false;
    if (fs::exists(fs::symlink_status(name))) return false;
    fs::rename(temporary_, name);  // some file systems do not know that flag
    return true;
}

void OutputPath::commit() {
    const bool is_folder = fs::is_directory(temporary_);
    if (is_folder) {
        syncFolder(temporary_, path_);
    } else {
        syncFile(temporary_, path_);
    }
    // Both take time.
    std::string taken;
    try {
        checkFree();
        if (!overwrites_ && !renameToFreeName(path_)) taken = path_.string() + " exists now";
    } catch (const fs::filesystem_error&) {
        throw;
    } catch (const std::runtime_error& e) {
        taken = e.what();
    }
    if (!taken.empty()) {
        throw std::runtime_error(taken + "; this run's output is " + keepPartial().string());
    }
    const fs::path old = overwrites_ ? replace(is_folder) : fs::path();
    kept_ = path_;
    syncFile(fs::absolute(path_).parent_path(), path_);
    if (!old.empty()) removeOld(old);
}

/// Gives the output its name. Returns where an older folder is now, if there was one.
fs::path OutputPath::replace(bool is_folder) const {
    if (!is_folder || !fs::is_directory(path_)) {
        std::error_code error;
        fs::rename(temporary_, path_, error);
        if (error) {
            throw std::runtime_error(path_.string() + ": cannot be replaced: " + error.message() +
                                     "; choose another name");
        }
        return {};
    }
    // rename() does not replace a non-empty folder. Exchanged, the name always has one of the two.
    if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, path_.c_str(), RENAME_EXCHANGE) == 0) {
        return temporary_;
    }
    // Some file systems cannot exchange.
    fs::path old = secretName(path_, ".old-");
    fs::rename(path_, old);
    try {
        fs::rename(temporary_, path_);
    } catch (const fs::filesystem_error&) {
        fs::rename(old, path_);
        throw;
    }
    return old;
}

/// This run's output has its name.
void OutputPath::removeOld(const fs::path& old) {
    const std::error_code error = removeAll(old);
    if (!error) return;
    living().remove(temporary_);  // the message means this name
    throw std::runtime_error(path_.string() +
                             ": is complete, but the older one cannot be removed and is " +
                             old.string() + " now: " + error.message());
}

fs::path OutputPath::keepPartial() {
    if (!kept_.empty()) return kept_;
    const bool is_folder = fs::is_directory(temporary_);
    fs::path stem = path_;
    if (!is_folder) stem.replace_extension();
    for (;;) {
        const fs::path name =
            freeName(stem, ".partial", is_folder ? fs::path() : path_.extension());
        // Another run may end at the same time.
        if (renameToFreeName(name)) return kept_ = name;
    }
}

std::string withOutputNames(std::string message) { return living().named(std::move(message)); }

RenamingNote::RenamingNote(const std::vector<fs::path>& outputs) {
    if (outputs.size() < 2) return;
    std::string text =
        "These outputs of one run were getting their names when this file was written. If it is "
        "still there, the run was killed meanwhile: outputs that are missing or older are complete "
        "under their temporary names (NAME" +
        std::string(kTemporaryMark) + std::to_string(getpid()) + "-*).\n";
    for (const fs::path& output : outputs) text += output.string() + "\n";
    fs::path first = outputs.front();
    if (!first.has_filename()) first = first.parent_path();
    try {
        file_ = secretName(first, ".unfinished-");
        std::ofstream(file_) << text;
    } catch (const fs::filesystem_error&) {  // a name too long
        file_.clear();
    } catch (const std::bad_alloc&) {  // for its buffer, once the file is there
        std::error_code ignored;
        fs::remove(file_, ignored);
    }
}

RenamingNote::~RenamingNote() {
    std::error_code ignored;  // destructors must not throw
    if (!file_.empty()) fs::remove(file_, ignored);
}

std::vector<fs::path> partialOutputs(const fs::path& output) {
    std::vector<fs::path> found;
    if (output.empty()) return found;
    const fs::path path = output.has_filename() ? output : output.parent_path();  // "folder/"
    const fs::path folder = fs::absolute(path).lexically_normal().parent_path();
    // As keepPartial() names them.
    const std::string start =
        (fs::is_directory(path) ? path.filename() : path.stem()).string() + ".partial";
    const std::string end = fs::is_directory(path) ? "" : path.extension().string();
    std::error_code unreadable;
    for (const fs::path& entry : entriesOf(folder, unreadable)) {
        const std::string name = entry.filename().string();
        if (isLeftBehind(entry, path.filename().string())) {
            found.push_back(path.parent_path() / name);
            continue;
        }
        if (name.size() < start.size() + end.size() || name.rfind(start, 0) != 0 ||
            name.compare(name.size() - end.size(), end.size(), end) != 0) {
            continue;
        }
        const std::string number =
            name.substr(start.size(), name.size() - end.size() - start.size());
        const bool is_number = number.size() > 1 && number[0] == '-' &&
                               number.find_first_not_of("0123456789", 1) == std::string::npos;
        if (number.empty() || is_number) found.push_back(path.parent_path() / name);
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::string leftBehind(const std::vector<fs::path>& outputs) {
    std::string names;
    for (const fs::path& output : outputs) {
        for (const fs::path& left : partialOutputs(output)) {
            names += (names.empty() ? "" : ", ") + left.string();
        }
    }
    if (names.empty()) return "";
    return "earlier runs that broke off left " + names + "; delete what you do not need";
}

void checkApart(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs,
                const std::string& role) {
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        if (output->empty()) continue;
        for (const fs::path& input : inputs) {
            if (input.empty()) continue;
            if (isWithin(input, *output)) {
                throw std::runtime_error(output->string() + ": is or contains " + role +
                                         "; choose another output");
            }
            if (fs::exists(*output) && isWithin(*output, input)) {
                throw std::runtime_error(output->string() + ": is in " + role + " " +
                                         input.string() +
                                         " and may be a part of it, so it is not replaced; choose "
                                         "another output");
            }
        }
        for (auto other = output + 1; other != outputs.end(); ++other) {
            if (other->empty()) continue;
            if (!isWithin(*output, *other) && !isWithin(*other, *output)) continue;
            throw std::runtime_error(output->string() + " and " + other->string() +
                                     ": one output is inside the other; use separate paths");
        }
    }
}

}  // namespace hagen::base
