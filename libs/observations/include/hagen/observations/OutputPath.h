#pragma once
#include <filesystem>

namespace hagen {

/// A file or folder that is written beside its place under a temporary name, and appears under its
/// own only when it is whole.
class OutputPath {
 public:
    /// Clears away what an earlier, interrupted run has left under the temporary name.
    /// Throws std::runtime_error where `path` exists and `overwrite` is not set, and where its
    /// folder is missing.
    OutputPath(std::filesystem::path path, bool overwrite);
    /// Removes what was written, unless commit() or keepPartial() was called.
    ~OutputPath();
    OutputPath(const OutputPath&) = delete;
    OutputPath& operator=(const OutputPath&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// Where to write: beside path(), on the same file system.
    const std::filesystem::path& temporary() const { return temporary_; }

    /// Gives what was written its name; replaces what had it.
    void commit() { moveTo(path_); }
    /// Names it as part of an output: "x.rawlog" becomes "x.partial.rawlog". Returns that name.
    std::filesystem::path keepPartial();

 private:
    void moveTo(const std::filesystem::path& name);

    std::filesystem::path path_, temporary_;
};

}  // namespace hagen
