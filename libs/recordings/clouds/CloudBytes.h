#pragma once
#include <hagen/mrpt/PointTable.h>
#include "recordings/clouds/CloudFile.h"

#include <array>
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

/// The whole file. Throws BrokenRecording.
Bytes readBytes(const std::filesystem::path& file);

/// Throws BrokenRecording: "scan.pcd: line 3: what".
[[noreturn]] void failAt(const std::filesystem::path& file, const std::string& place,
                         const std::string& what);

/// A little-endian number at a byte that is there.
template <class Number>
Number numberAt(const Bytes& bytes, std::size_t at) {
    Number number;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
}

/// Lines of text at the start of, or in, a file. Ends of lines are "\n" or "\r\n".
class TextLines {
 public:
    explicit TextLines(const Bytes& bytes) : bytes_(bytes) {}

    /// The next line without its end; none at the end of the file.
    std::optional<std::string_view> next();
    std::size_t number() const { return number_; }  ///< of the last line, from 1
    std::size_t position() const { return at_; }    ///< the byte after the last line
    /// "line 12"
    std::string place() const { return "line " + std::to_string(number_); }

 private:
    const Bytes& bytes_;
    std::size_t at_ = 0, number_ = 0;
};

/// The parts between blanks.
std::vector<std::string_view> wordsOf(std::string_view line);

/// Writes the number that `word` spells in this type; false if it is no such number.
bool putNumber(std::string_view word, observations::NumberType type, std::uint8_t* to);

/// Throws BrokenRecording if these are more points than a scan may have (kMaxReturns). Call it
/// before a table is made of them, which takes memory.
void checkNumber(const std::filesystem::path& file, std::size_t points);

/// Throws BrokenRecording unless `points` records of `bytes_per_point` fit into the `there` bytes
/// that remain of a file, and for more than checkNumber() allows.
void checkRoom(const std::filesystem::path& file, std::size_t points, std::size_t bytes_per_point,
               std::size_t there);

/// The remark on bytes after the last point; empty without any.
std::vector<std::string> remarkOnRest(std::size_t bytes);

}  // namespace hagen::recordings
