#pragma once
#include <filesystem>
#include <vector>

namespace hagen::base {

/// What an output is made of. Only an output of the same kind is replaced: anything else in its
/// place is somebody's work.
struct OutputKind {
    const char* what;  ///< "a scan folder", for messages
    /// Whether a file belongs to such a folder, by its path within it; null for outputs that are a
    /// file.
    bool (*holds)(const std::filesystem::path& within);
};
constexpr OutputKind kFile{"a file", nullptr};

/// A file or folder that is written beside its place under a temporary name, and appears under its
/// own only when it is whole.
class OutputPath {
 public:
    /// Throws std::runtime_error, naming the path, where it exists and `overwrite` is not set;
    /// where it exists and is of another kind (a folder for a file, a device, a folder that holds
    /// anything but the kind's files): such are never replaced; and where its folder is missing.
    OutputPath(std::filesystem::path path, const OutputKind& kind, bool overwrite);
    /// Removes what was written, unless commit() or keepPartial() was called.
    ~OutputPath();
    OutputPath(const OutputPath&) = delete;
    OutputPath& operator=(const OutputPath&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// Where to write: beside path(), on the same file system, a name that nothing has.
    const std::filesystem::path& temporary() const { return temporary_; }

    /// Gives what was written its name; replaces what had it. Where something has that name since
    /// that may not be replaced, keeps this as a part, and throws std::runtime_error that says so.
    void commit();
    /// Names it as part of an output: "x.rawlog" becomes "x.partial.rawlog", or
    /// "x.partial-2.rawlog" where that is taken. Returns that name.
    std::filesystem::path keepPartial();

 private:
    void checkFree() const;

    std::filesystem::path path_, temporary_;
    OutputKind kind_;
    bool overwrites_;
};

/// Throws std::runtime_error, naming them, where an output is one of the inputs or holds one, or
/// lies in another output. Empty paths are none.
void checkApart(const std::vector<std::filesystem::path>& outputs,
                const std::vector<std::filesystem::path>& inputs);

}  // namespace hagen::base
