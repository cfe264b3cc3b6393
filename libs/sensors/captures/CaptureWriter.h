#pragma once
#include <hagen/sensors/CaptureFile.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace hagen::sensors {

/// Writes UDP datagrams to a capture (.pcap with nanoseconds), each as one Ethernet frame. Writes
/// blocks of whole frames, so that the capture stays readable if the process is killed.
class CaptureWriter {
 public:
    /// Creates the file. Throws std::runtime_error naming the file and the reason.
    explicit CaptureWriter(const std::filesystem::path& file);

    /// Adds a datagram. Returns true if it completed a block, which was written to the file. Throws
    /// std::runtime_error naming the file if writing fails; the file then ends with the previous
    /// block.
    bool add(const Datagram& datagram);
    /// Writes the unfinished block. Throws like add().
    void flush();

 private:
    std::filesystem::path file_;
    std::ofstream out_;
    std::string block_;
    std::uintmax_t written_bytes_ = 0;
};

}  // namespace hagen::sensors
