#include <hagen/captures/LidarCapture.h>
#include <hagen/captures/LivoxCapture.h>
#include <hagen/captures/OusterCapture.h>
#include <hagen/captures/VelodyneCapture.h>

#include <stdexcept>

#include <hagen/packets/LivoxPacket.h>

namespace hagen::captures {
namespace {

/// Whether the first datagrams have points of a Livox. What cannot be read is reported later.
bool isOfLivox(const std::filesystem::path& file) {
    constexpr int kDatagrams = 1000;
    packets::CaptureFile capture(file);
    packets::Datagram datagram;
    try {
        for (int i = 0; i < kDatagrams && capture.next(datagram); ++i) {
            if (packets::livoxPacketOf(datagram)) return true;
        }
    } catch (const packets::BrokenCapture&) {
    }
    return false;
}

}  // namespace

std::unique_ptr<LidarCapture> openCapture(const std::filesystem::path& file,
                                          const std::filesystem::path& sensor_json,
                                          const std::filesystem::path& calibration) {
    const bool is_velodyne = sensor_json.empty() && !isOfLivox(file);
    if (!calibration.empty() && !is_velodyne) {
        throw std::runtime_error(file.string() + ": is read as a capture of " +
                                 (sensor_json.empty() ? "a Livox" : "an Ouster") + ", which " +
                                 calibration.string() + " cannot describe: it is of an HDL-64E");
    }
    if (!sensor_json.empty()) return std::make_unique<OusterCapture>(file, sensor_json);
    if (!is_velodyne) return std::make_unique<LivoxCapture>(file);
    return std::make_unique<VelodyneCapture>(file, calibration);
}

}  // namespace hagen::captures
