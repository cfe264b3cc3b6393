#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace hagen::base {

/// What a file seems to be that no reader knows, for messages.
struct FileKind {
    std::string what;    ///< "a JPEG picture", "text"; empty: none that is known
    std::string advice;  ///< "unpack it first"; empty: there is none
    /// "it seems to be a ZIP archive: unpack it first"; empty if it is none that is known.
    std::string text() const;
};

constexpr std::size_t kFileKindBytes = 4096;  ///< first bytes of a file that tell its kind

/// Whether bytes are text in UTF-8, with no control characters but white space; its last character
/// may be cut.
bool isText(std::string_view bytes);

/// By the first bytes of a file: kFileKindBytes, or all if it has fewer.
FileKind kindOfBytes(std::string_view start);
/// The same of a file; none that is known if it cannot be read.
FileKind kindOfFile(const std::filesystem::path& file);

}  // namespace hagen::base
