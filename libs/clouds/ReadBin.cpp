#include "Readers.h"

namespace hagen::clouds {

using observations::NumberType;

CloudFile readBin(const std::filesystem::path& file, Bytes bytes) {
    constexpr std::size_t kBytesPerPoint = 16;
    if (bytes.size() % kBytesPerPoint != 0) {
        throw BrokenCloud(file.string() + ": " + std::to_string(bytes.size()) +
                          " bytes are not a multiple of 16-byte points; is it truncated?");
    }
    CloudFile cloud;
    cloud.table.fields = {{"x", NumberType::Float32, 0, 1},
                          {"y", NumberType::Float32, 4, 1},
                          {"z", NumberType::Float32, 8, 1},
                          {"intensity", NumberType::Float32, 12, 1}};
    cloud.table.bytes_per_point = kBytesPerPoint;
    cloud.table.points = bytes.size() / kBytesPerPoint;
    cloud.table.bytes = std::move(bytes);
    return cloud;
}

}  // namespace hagen::clouds
