#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/recordings/ScanSource.h>
#include "sensors/captures/CaptureWriter.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

namespace hagen::convert {

/// A network capture of packets as an output. Each LiDAR has its own address.
class PacketCapture {
 public:
    /// Throws like OutputPath.
    PacketCapture(const std::filesystem::path& file, bool overwrite)
        : path_(file, base::kFile, overwrite), writer_(path_.temporary()) {}

    const base::OutputPath& place() const { return path_; }
    void add(const std::string& sensor_label, sensors::Datagram datagram);
    void commit() {
        writer_.flush();
        path_.commit();
    }
    std::filesystem::path keepPartial() {
        writer_.flush();
        return path_.keepPartial();
    }

 private:
    base::OutputPath path_;
    sensors::CaptureWriter writer_;
    std::map<std::string, std::uint32_t> ip_of_;  ///< by label
};

/// Writes the packets of a rawlog or bag to a capture; returns their number. Throws
/// std::runtime_error naming the recording if it is a capture or has no packets.
std::size_t capturePackets(const std::filesystem::path& recording,
                           recordings::SourceOptions options, const std::filesystem::path& capture,
                           bool overwrite);

}  // namespace hagen::convert
