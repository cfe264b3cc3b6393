#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace hagen::base {

/// The likely kind of an unreadable file, for messages.
struct FileKind {
    std::string what;    ///< "a JPEG picture", "text"; empty if unknown
    std::string advice;  ///< "unpack it first"; may be empty
    /// Such as "it seems to be a ZIP archive: unpack it first"; empty if the kind is unknown.
    std::string text() const;
};

constexpr std::size_t kFileKindBytes = 4096;

/// True for UTF-8 text without control characters other than white space. The last character may be
/// truncated.
bool isText(std::string_view bytes);

/// `start`: the first kFileKindBytes of a file, or all bytes if it is shorter.
FileKind kindOfBytes(std::string_view start);
/// Like kindOfBytes(), but reads the file; unknown if it cannot be read.
FileKind kindOfFile(const std::filesystem::path& file);

}  // namespace hagen::base
