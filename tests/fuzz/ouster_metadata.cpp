// Ouster metadata (JSON).
#include "sensors/ouster/OusterFrames.h"
#include "sensors/ouster/OusterSensor.h"

#include "fuzz/Target.h"
#include "support/OusterPackets.h"

namespace hagen::fuzz {
namespace {

void readMetadata(std::string_view input) {
    mayRefuse([&] {
        const auto sensor = sensors::ousterSensorOf(std::string(input), "metadata");
        require(sensor.packetBytes() <= 65536, "a packet that no datagram holds");
        require(sensor.windowColumns() <= sensor.columns_per_frame, "more columns than a turn has");
        // The sensor accepts any packet of its size.
        const std::string packet(sensor.packetBytes(), '\1');
        sensors::OusterFrames frames(sensor);
        frames.add(reinterpret_cast<const std::uint8_t*>(packet.data()), 0);
        frames.finish();
    });
}

Seeds metadataSeeds() {
    return {test::ousterJson(), test::ousterJson("LEGACY"), test::ousterJson("FIVE_WORD_PIXEL"),
            test::ousterJson("FUSA_RNG15_RFL8_NIR8_DUAL")};
}

const bool kAdded =
    add({"ouster_metadata", readMetadata, metadataSeeds,
         wordsIn("beam_altitude_angles beam_azimuth_angles lidar_data_format sensor_info "
                 "beam_intrinsics lidar_intrinsics column_window columns_per_frame "
                 "columns_per_packet pixels_per_column udp_profile_lidar pixel_shift_by_row "
                 "lidar_to_sensor_transform beam_to_lidar_transform null 1e999 -1 4294967296 "
                 "[] {}")});

}  // namespace
}  // namespace hagen::fuzz
