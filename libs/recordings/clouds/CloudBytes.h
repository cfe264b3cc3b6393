#pragma once
#include <hagen/mrpt/PointTable.h>
#include "recordings/clouds/CloudFile.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hagen::recordings {

using Bytes = std::vector<std::uint8_t>;

/// Reads a whole file. Throws BrokenRecording.
Bytes readBytes(const std::filesystem::path& file);

/// Throws BrokenRecording with a message such as "scan.pcd: line 3: what".
[[noreturn]] void failAt(const std::filesystem::path& file, const std::string& place,
                         const std::string& what);

/// Reads a little-endian number at a position in the bytes.
template <class Number>
Number numberAt(const Bytes& bytes, std::size_t at) {
    Number number;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
}

/// Iterates over the lines of a text file. Lines end in LF, CRLF or, if the first one does, CR.
class TextLines {
 public:
    explicit TextLines(const Bytes& bytes);

    /// Returns the next line without its ending; nullopt at the end of the file.
    std::optional<std::string_view> next();
    std::size_t number() const { return number_; }  ///< number of the last line, 1-based
    std::size_t position() const { return at_; }    ///< position after the last line
    /// The place of the last line, such as "line 12".
    std::string place() const { return "line " + std::to_string(number_); }

 private:
    const Bytes& bytes_;
    char ending_ = '\n';
    std::size_t at_ = 0, number_ = 0;
};

/// The start of a word in quotes for messages, or "binary data".
std::string quoted(std::string_view word);

/// Splits a line at white space.
std::vector<std::string_view> wordsOf(std::string_view line);

/// Parses `word` as a number of this type and writes it. Returns false if it is not such a number.
bool putNumber(std::string_view word, observations::NumberType type, std::uint8_t* to);

/// Throws BrokenRecording if `points` exceeds kMaxReturns. Call it before allocating a table.
void checkNumber(const std::filesystem::path& file, std::size_t points);

/// Throws BrokenRecording if checkNumber() does, or unless `points` records of `bytes_per_point`
/// fit into the `there` remaining bytes of the file.
void checkRoom(const std::filesystem::path& file, std::size_t points, std::size_t bytes_per_point,
               std::size_t there);

/// A remark on bytes after the last point; empty if there are no such bytes.
std::vector<std::string> remarkOnRest(std::size_t bytes);

}  // namespace hagen::recordings
