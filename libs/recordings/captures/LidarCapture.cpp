#include <hagen/recordings/LidarCapture.h>
#include <hagen/recordings/LivoxCapture.h>
#include <hagen/recordings/OusterCapture.h>
#include <hagen/recordings/VelodyneCapture.h>

#include <stdexcept>

#include <hagen/sensors/LivoxPacket.h>

namespace hagen::recordings {
namespace {

/// Whether the first datagrams have points of a Livox. What cannot be read is reported later.
bool isOfLivox(const std::filesystem::path& file, const std::function<void()>& check) {
    constexpr int kDatagrams = 1000;
    constexpr std::size_t kMostFrames = 1000000;
    struct TooManyFrames {};
    sensors::CaptureFile capture(file);
    // A search without end would be one for a datagram that is not there.
    capture.checkWhileReading([&] {
        if (check) check();
        if (capture.counts().frames >= kMostFrames) throw TooManyFrames();
    });
    sensors::Datagram datagram;
    try {
        for (int i = 0; i < kDatagrams && capture.next(datagram); ++i) {
            if (sensors::livoxPacketOf(datagram)) return true;
        }
    } catch (const sensors::BrokenCapture&) {
    } catch (const TooManyFrames&) {
    }
    return false;
}

std::unique_ptr<LidarCapture> openKind(const std::filesystem::path& file,
                                       const std::filesystem::path& sensor_json,
                                       const std::filesystem::path& calibration,
                                       const std::function<void()>& check) {
    const bool is_velodyne = sensor_json.empty() && !isOfLivox(file, check);
    if (!calibration.empty() && !is_velodyne) {
        throw std::runtime_error(file.string() + ": is read as a capture of " +
                                 (sensor_json.empty() ? "a Livox" : "an Ouster") + ", which " +
                                 calibration.string() + " cannot describe: it is of an HDL-64E");
    }
    if (!sensor_json.empty()) return std::make_unique<OusterCapture>(file, sensor_json);
    if (!is_velodyne) return std::make_unique<LivoxCapture>(file);
    return std::make_unique<VelodyneCapture>(file, calibration);
}

}  // namespace

std::unique_ptr<LidarCapture> openCapture(const std::filesystem::path& file,
                                          const std::filesystem::path& sensor_json,
                                          const std::filesystem::path& calibration,
                                          const std::function<void()>& check) {
    auto capture = openKind(file, sensor_json, calibration, check);
    if (check) capture->checkWhileReading(check);
    return capture;
}

}  // namespace hagen::recordings
