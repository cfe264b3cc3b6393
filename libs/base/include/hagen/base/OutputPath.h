#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::base {

/// The type of an output. An existing output is replaced only by one of the same type; anything
/// else in its place belongs to the user.
struct OutputKind {
    const char* what;  ///< "a scan folder", for messages
    /// True if a file belongs to such a folder, by its path within the folder; null if the output
    /// is a file.
    bool (*holds)(const std::filesystem::path& within);
    const char* marker = nullptr;  ///< a file that each such folder has; null: none
    /// True if a folder was made by an earlier run; null if `marker` decides.
    bool (*is_made)(const std::filesystem::path& folder) = nullptr;
};
constexpr OutputKind kFile{"a file", nullptr};

/// A file or folder that is written next to its destination under a temporary name and renamed when
/// complete.
class OutputPath {
 public:
    /// Throws std::runtime_error if the path exists and `overwrite` is not set, or if its parent
    /// folder is missing. Never replaces a mount point or anything of another type: a folder for a
    /// file, a device, a folder with other files. The message names the path.
    OutputPath(std::filesystem::path path, const OutputKind& kind, bool overwrite);
    /// Removes the temporary file unless commit() or keepPartial() was called.
    ~OutputPath();
    OutputPath(const OutputPath&) = delete;
    OutputPath& operator=(const OutputPath&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// Where to write: an unpredictable name next to path(), on the same file system.
    const std::filesystem::path& temporary() const { return temporary_; }

    /// Flushes the output to the disk, renames it into place and replaces an older one. If
    /// something that must not be replaced has appeared there, keeps the output as a partial one
    /// and throws std::runtime_error.
    void commit();
    /// Keeps the output under a partial name: "x.rawlog" becomes "x.partial.rawlog", or
    /// "x.partial-2.rawlog" if that is taken. Returns the name.
    std::filesystem::path keepPartial();

 private:
    void checkFree() const;
    bool renameToFreeName(const std::filesystem::path& name) const;
    std::filesystem::path replace() const;

    std::filesystem::path path_, temporary_;
    std::filesystem::path kept_;  ///< its name, once it has one
    OutputKind kind_;
    bool overwrites_;
};

/// Leftovers of an output from earlier runs, sorted by name: partial outputs (keepPartial()), and
/// temporary files of processes that have ended. Empty for an empty path.
std::vector<std::filesystem::path> partialOutputs(const std::filesystem::path& output);

/// A message with the names of outputs in place of their temporary ones.
std::string withOutputNames(const std::string& message);

/// partialOutputs() of several outputs as a sentence for the user; "" if there are none.
std::string leftBehind(const std::vector<std::filesystem::path>& outputs);

/// Throws std::runtime_error if an output is an input, contains an input, exists within an input,
/// or lies in another output; the message names both. Empty paths are ignored. `role`: what the
/// inputs are.
void checkApart(const std::vector<std::filesystem::path>& outputs,
                const std::vector<std::filesystem::path>& inputs,
                const std::string& role = "the input");

}  // namespace hagen::base
