#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace hagen::recordings {

/// Reads a file sequentially and optionally computes its CRC.
class FileBytes {
 public:
    /// Throws BrokenRecording naming the file if it cannot be opened.
    explicit FileBytes(const std::filesystem::path& file, bool has_crc = false);

    std::uint64_t position() const { return position_; }
    std::uint64_t left() const { return size_ > position_ ? size_ - position_ : 0; }
    double fractionRead() const;

    /// Reads exactly `count` bytes. Does not allocate if the file has fewer. `what` names the data
    /// in exceptions (BrokenRecording), such as "a chunk".
    void read(std::uint64_t count, const std::string& what, std::vector<std::uint8_t>& bytes);
    /// Begins to skip bytes. Call skipSome() while isSkipping(), so that skipping can be
    /// interrupted. Skipped bytes are part of the CRC.
    void beginSkip(std::uint64_t count, const std::string& what);
    bool isSkipping() const { return to_skip_ > 0; }
    void skipSome();

    /// CRC-32 (as in zlib) of all bytes since it was last restarted.
    std::uint32_t crc() const { return crc_; }
    void restartCrc() { crc_ = 0; }

    /// "FILE: WHAT at byte N: WHY"
    std::string textOf(const std::string& what, std::uint64_t byte, const std::string& why) const;
    /// Throws BrokenRecording with this text.
    [[noreturn]] void fail(const std::string& what, std::uint64_t byte,
                           const std::string& why) const;

 private:
    void readInto(std::uint8_t* bytes, std::size_t count, const std::string& what);
    void checkLeft(std::uint64_t count, const std::string& what) const;

    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Close> file_;
    std::uint64_t size_ = 0, position_ = 0, to_skip_ = 0;
    std::string skipped_;
    bool has_crc_;
    std::uint32_t crc_ = 0;
};

}  // namespace hagen::recordings
