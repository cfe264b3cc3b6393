#pragma once
#include <hagen/sensors/CaptureFile.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace hagen::sensors {

/// Writes UDP datagrams to a capture (.pcap with nanoseconds), each as one Ethernet frame. Frames
/// reach the file whole, in blocks: a killed process leaves a capture that can be read.
class CaptureWriter {
 public:
    /// Creates the file. Throws std::runtime_error naming it and the reason.
    explicit CaptureWriter(const std::filesystem::path& file);

    /// Adds a datagram. Returns whether that completed a block, which is then in the file. Throws
    /// std::runtime_error naming the file if it cannot be written; it then ends with the block
    /// before.
    bool add(const Datagram& datagram);
    /// Writes what was added since the last block. Throws like add().
    void flush();

 private:
    std::filesystem::path file_;
    std::ofstream out_;
    std::string block_;
    std::uintmax_t written_bytes_ = 0;
};

}  // namespace hagen::sensors
