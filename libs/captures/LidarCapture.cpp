#include <hagen/captures/LidarCapture.h>
#include <hagen/captures/OusterCapture.h>
#include <hagen/captures/VelodyneCapture.h>

namespace hagen::captures {

std::unique_ptr<LidarCapture> openCapture(const std::filesystem::path& file,
                                          const std::filesystem::path& sensor_json) {
    if (sensor_json.empty()) return std::make_unique<VelodyneCapture>(file);
    return std::make_unique<OusterCapture>(file, sensor_json);
}

}  // namespace hagen::captures
