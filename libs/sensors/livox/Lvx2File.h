#pragma once
#include <hagen/sensors/Datagram.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

namespace hagen::sensors {

/// Reads the packages of a Livox Viewer 2 recording (.lvx2) as datagrams of Livox SDK 2, which the
/// sensors sent. Functions throw std::runtime_error without naming the file.
class Lvx2File {
 public:
    explicit Lvx2File(const std::filesystem::path& file);

    /// Reads the next package; returns false at the end.
    bool next(Datagram& datagram);
    /// Position of the last package.
    std::int64_t position() const { return position_; }

    /// True if the file starts like a .lvx2 file.
    static bool isLvx2(const std::filesystem::path& file);

 private:
    bool read(std::uint8_t* to, std::size_t size, bool may_end = false);
    bool startFrame();

    std::ifstream in_;
    std::vector<std::uint8_t> packet_;  ///< the last datagram
    std::int64_t position_ = 0, frame_end_ = 0, file_end_ = 0;
};

}  // namespace hagen::sensors
