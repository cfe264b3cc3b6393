#include <unistd.h>

#include <hagen/base/OutputPath.h>
#include <algorithm>
#include <stdexcept>
#include <string>

namespace hagen::base {
namespace {

namespace fs = std::filesystem;

/// Returns the first file in a folder that does not belong to such an output, searching `depth`
/// folders deep; empty if there is none.
fs::path foreignPart(const fs::path& folder, const fs::path& output, const OutputKind& kind,
                     int depth) {
    for (const auto& entry : fs::directory_iterator(folder)) {
        const bool is_file = fs::is_regular_file(fs::symlink_status(entry.path()));
        if (is_file && kind.holds(entry.path().lexically_relative(output))) continue;
        if (depth == 0 || !entry.is_directory() || entry.is_symlink()) return entry.path();
        fs::path foreign = foreignPart(entry.path(), output, kind, depth - 1);
        if (!foreign.empty()) return foreign;
    }
    return {};
}

void checkReplaceable(const fs::path& path, const OutputKind& kind) {
    if (kind.holds == nullptr) {
        if (!fs::is_regular_file(path)) {
            throw std::runtime_error(path.string() +
                                     ": not a file, so it is not replaced; choose another name");
        }
        return;
    }
    if (!fs::is_directory(path)) {
        throw std::runtime_error(path.string() +
                                 ": not a folder, so it is not replaced; choose another name");
    }
    if (kind.marker != nullptr && !fs::is_empty(path) && !fs::exists(path / kind.marker)) {
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

}  // namespace

OutputPath::OutputPath(fs::path path, const OutputKind& kind, bool overwrite)
    : path_(std::move(path)), kind_(kind), overwrites_(overwrite) {
    if (!path_.has_filename()) path_ = path_.parent_path();  // "folder/"
    checkFree();
    const fs::path folder = fs::absolute(path_).lexically_normal().parent_path();
    if (!fs::is_directory(folder)) {
        throw std::runtime_error(folder.string() + ": no such folder to write to");
    }
    temporary_ = freeName(path_, ".tmp-" + std::to_string(getpid()), "");
}

OutputPath::~OutputPath() {
    std::error_code ignored;  // destructors must not throw
    fs::remove_all(temporary_, ignored);
}

void OutputPath::checkFree() const {
    if (!fs::exists(fs::symlink_status(path_))) return;
    if (!overwrites_) {
        throw std::runtime_error(path_.string() + " exists; use --overwrite to replace it");
    }
    checkReplaceable(path_, kind_);
}

void OutputPath::commit() {
    try {
        checkFree();
    } catch (
        const std::runtime_error& e) {  // created by someone else since the constructor's check
        throw std::runtime_error(std::string(e.what()) + "; this run's output is " +
                                 keepPartial().string());
    }
    if (!fs::is_directory(path_)) {
        fs::rename(temporary_, path_);
        return;
    }
    // rename() does not replace a non-empty folder.
    const fs::path old = freeName(path_, ".old-" + std::to_string(getpid()), "");
    fs::rename(path_, old);
    fs::rename(temporary_, path_);
    fs::remove_all(old);
}

fs::path OutputPath::keepPartial() {
    const bool is_folder = fs::is_directory(temporary_);
    fs::path stem = path_;
    if (!is_folder) stem.replace_extension();
    fs::path name = freeName(stem, ".partial", is_folder ? fs::path() : path_.extension());
    fs::rename(temporary_, name);
    return name;
}

std::vector<fs::path> partialOutputs(const fs::path& path) {
    std::vector<fs::path> found;
    if (path.empty()) return found;
    const fs::path folder = fs::absolute(path).lexically_normal().parent_path();
    // As keepPartial() names them.
    const std::string start =
        (fs::is_directory(path) ? path.filename() : path.stem()).string() + ".partial";
    const std::string end = fs::is_directory(path) ? "" : path.extension().string();
    std::error_code unreadable;
    for (const auto& entry : fs::directory_iterator(folder, unreadable)) {
        const std::string name = entry.path().filename().string();
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

void checkApart(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs) {
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        if (output->empty()) continue;
        for (const fs::path& input : inputs) {
            if (input.empty() || !isWithin(input, *output)) continue;
            throw std::runtime_error(output->string() +
                                     ": is or contains the input; choose another output");
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
