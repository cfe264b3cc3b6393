#include "recordings/bags/FileBytes.h"

#include <zlib.h>
#include "recordings/bags/BagFile.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace hagen::recordings {

FileBytes::FileBytes(const std::filesystem::path& file, bool has_crc)
    : path_(file), file_(std::fopen(file.c_str(), "rb")), has_crc_(has_crc) {
    if (!file_) {
        throw BrokenRecording(file.string() + ": cannot be opened: " + std::strerror(errno));
    }
    size_ = std::filesystem::file_size(file);
    std::setvbuf(file_.get(), nullptr, _IOFBF, 1 << 18);
}

double FileBytes::fractionRead() const {
    return size_ == 0 ? 1.0 : static_cast<double>(position_) / static_cast<double>(size_);
}

std::string FileBytes::textOf(const std::string& what, std::uint64_t byte,
                              const std::string& why) const {
    return path_.string() + ": " + what + " at byte " + std::to_string(byte) + ": " + why;
}

void FileBytes::fail(const std::string& what, std::uint64_t byte, const std::string& why) const {
    throw BrokenRecording(textOf(what, byte, why));
}

void FileBytes::checkLeft(std::uint64_t count, const std::string& what) const {
    if (count <= left()) return;
    fail(what, position_,
         "is truncated: expected " + std::to_string(count) + " bytes, found " +
             std::to_string(left()));
}

void FileBytes::readInto(std::uint8_t* bytes, std::size_t count, const std::string& what) {
    if (std::fread(bytes, 1, count, file_.get()) != count) {
        fail(what, position_, "cannot be read: " + std::string(std::strerror(errno)));
    }
    if (has_crc_) crc_ = static_cast<std::uint32_t>(crc32_z(crc_, bytes, count));
    position_ += count;
}

void FileBytes::read(std::uint64_t count, const std::string& what,
                     std::vector<std::uint8_t>& bytes) {
    checkLeft(count, what);
    const auto size = static_cast<std::size_t>(count);
    if (bytes.capacity() < size) {  // spare room avoids an allocation per chunk
        bytes = {};
        bytes.reserve(size + size / 4);
    }
    bytes.resize(size);
    if (count > 0) readInto(bytes.data(), bytes.size(), what);
}

void FileBytes::beginSkip(std::uint64_t count, const std::string& what) {
    checkLeft(count, what);
    to_skip_ = count;
    skipped_ = what;
}

void FileBytes::skipSome() {
    std::uint8_t some[1 << 16];
    const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(to_skip_, sizeof some));
    readInto(some, part, skipped_);
    to_skip_ -= part;
}

}  // namespace hagen::recordings
