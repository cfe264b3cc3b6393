#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::base {

/// The type of an output. An existing output is replaced only by one of the same type; anything
/// else in its place belongs to the user.
struct OutputKind {
    const char* what;  ///< "a scan folder", for messages
    /// True if a file belongs to such a folder, by its path within the folder; null for outputs
    /// that are files.
    bool (*holds)(const std::filesystem::path& within);
    /// A file that each such folder has, where the names of the others do not tell whose they are.
    /// Null: none.
    const char* marker = nullptr;
    /// Whether a folder is of an earlier run, where that takes more than one name. Null: not asked.
    bool (*is_made)(const std::filesystem::path& folder) = nullptr;
};
constexpr OutputKind kFile{"a file", nullptr};

/// A file or folder that is written next to its destination under a temporary name and renamed when
/// complete.
class OutputPath {
 public:
    /// Throws std::runtime_error if the path exists and `overwrite` is not set, or if its parent
    /// folder is missing. Existing paths of another type are never replaced (a folder for a file, a
    /// device, a folder with files of any other type): throws as well. So are mount
    /// points, and the folder in which the program runs. The message names the path.
    OutputPath(std::filesystem::path path, const OutputKind& kind, bool overwrite);
    /// Removes the temporary file unless commit() or keepPartial() was called.
    ~OutputPath();
    OutputPath(const OutputPath&) = delete;
    OutputPath& operator=(const OutputPath&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// Where to write: an unused name next to path(), on the same file system, that nobody can know
    /// in advance.
    const std::filesystem::path& temporary() const { return temporary_; }

    /// Has the output reach the disk, renames it into place and replaces an older one. If the path
    /// has been taken by something that must not be replaced, keeps the output as a partial one and
    /// throws std::runtime_error that says so.
    void commit();
    /// Keeps the output under a partial name: "x.rawlog" becomes "x.partial.rawlog", or
    /// "x.partial-2.rawlog" if that is taken. Returns the name.
    std::filesystem::path keepPartial();

 private:
    void checkFree() const;
    bool renameToFreeName(const std::filesystem::path& name) const;
    std::filesystem::path replace(bool is_folder) const;
    void removeOld(const std::filesystem::path& old);

    std::filesystem::path path_, temporary_;
    std::filesystem::path kept_;  ///< its name, once it has one
    OutputKind kind_;
    bool overwrites_;
};

/// A text file beside the first of several outputs while they get their names one after the other:
/// if the process is killed meanwhile, it tells where the others are.
class RenamingNote {
 public:
    /// None for fewer than two outputs, or if it cannot be written.
    explicit RenamingNote(const std::vector<std::filesystem::path>& outputs);
    ~RenamingNote();
    RenamingNote(const RenamingNote&) = delete;
    RenamingNote& operator=(const RenamingNote&) = delete;

 private:
    std::filesystem::path file_;
};

/// What earlier runs left of an output, sorted by name: all partial names of its path that there
/// are (keepPartial()), and the temporary names of processes that do not run any more, or that had
/// this one's number. Empty for an empty path.
std::vector<std::filesystem::path> partialOutputs(const std::filesystem::path& output);

/// A message with the names of outputs in place of their temporary ones.
std::string withOutputNames(std::string message);

/// The same as partialOutputs() for several outputs, as a sentence for the user; "" if there is
/// nothing.
std::string leftBehind(const std::vector<std::filesystem::path>& outputs);

/// Throws std::runtime_error if an output is an input, contains an input, exists within an input,
/// or lies in another output; the message names both. Empty paths are ignored. `role`: what the
/// inputs are.
void checkApart(const std::vector<std::filesystem::path>& outputs,
                const std::vector<std::filesystem::path>& inputs,
                const std::string& role = "the input");

}  // namespace hagen::base
