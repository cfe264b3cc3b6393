#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::base {

/// The type of an output. An output replaces only an output of the same type, because anything else
/// at that path belongs to the user.
struct OutputKind {
    const char* what;  ///< name for messages, such as "a scan folder"
    /// True if a path within the folder is part of such an output; null if the output is a file.
    bool (*holds)(const std::filesystem::path& within);
    const char* marker = nullptr;  ///< a file in every folder of this type; null if there is none
    /// True if an earlier run created the folder; null if `marker` decides.
    bool (*is_made)(const std::filesystem::path& folder) = nullptr;
};
constexpr OutputKind kFile{"a file", nullptr};

/// A file or folder written next to its destination under a temporary name and renamed when
/// complete.
class OutputPath {
 public:
    /// Creates missing parent folders. Throws std::runtime_error if the path exists and `overwrite`
    /// is not set, or if a parent folder cannot be created. Never replaces a mount point or
    /// anything of another type, such as a device or a folder with other files. The message names
    /// the path.
    OutputPath(std::filesystem::path path, const OutputKind& kind, bool overwrite);
    /// Removes the temporary file unless commit() or keepPartial() was called, and empty parent
    /// folders that the constructor created.
    ~OutputPath();
    OutputPath(const OutputPath&) = delete;
    OutputPath& operator=(const OutputPath&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// The path to write to: an unpredictable name next to path(), on the same file system.
    const std::filesystem::path& temporary() const { return temporary_; }

    /// Flushes the output to the disk and renames it into place, replacing a previous output. If
    /// something else has appeared there, calls keepPartial() and throws std::runtime_error.
    void commit();
    /// Keeps the output under a partial name: "x.rawlog" becomes "x.partial.rawlog", or
    /// "x.partial-2.rawlog" if that is taken. Returns the name.
    std::filesystem::path keepPartial();

 private:
    void checkFree() const;
    bool renameToFreeName(const std::filesystem::path& name) const;
    std::filesystem::path replace() const;

    std::filesystem::path path_, temporary_;
    std::filesystem::path kept_;                  ///< final path, once renamed
    std::vector<std::filesystem::path> created_;  ///< parent folders, deepest first
    OutputKind kind_;
    bool overwrites_;
};

/// Partial outputs of earlier runs (keepPartial()), sorted by name. Empty if the path is empty.
std::vector<std::filesystem::path> partialOutputs(const std::filesystem::path& output);

/// Replaces temporary names in a message with the names of the outputs.
std::string withOutputNames(const std::string& message);

/// Throws std::runtime_error if an output is an input, contains an input, is inside an input, or is
/// inside another output; the message names both. Ignores empty paths. `role` describes the inputs
/// in the message.
void checkApart(const std::vector<std::filesystem::path>& outputs,
                const std::vector<std::filesystem::path>& inputs,
                const std::string& role = "the input");

}  // namespace hagen::base
