#include "support/OusterPackets.h"

#include "support/Random.h"

namespace hagen::test {
namespace {

/// Appends a number, least significant byte first.
void put(std::string& bytes, std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
}

void putPixel(std::string& bytes, const sensors::OusterProfile& profile,
              const sensors::OusterFrame& frame, std::size_t at) {
    // The bits above the range contain flags.
    const std::uint32_t flags = 0x00f80000 & ~profile.range_mask;
    std::string pixel;
    if (profile.name == "LEGACY") {
        put(pixel, frame.range[at] | 0x00f00000, 4);
        put(pixel, frame.reflectivity[at], 2);
        put(pixel, 0x1234, 2);
        put(pixel, 0x5678, 4);
    } else if (profile.name == "RNG19_RFL8_SIG16_NIR16" ||
               profile.name == "RNG19_RFL8_SIG16_NIR16_ZONE16") {
        put(pixel, frame.range[at] | flags, 4);
        put(pixel, frame.reflectivity[at], 1);
        put(pixel, 0x12345678, 7);
    } else if (profile.name == "RNG19_RFL8_SIG16_NIR16_DUAL") {
        put(pixel, frame.range[at] | flags, 3);
        put(pixel, frame.reflectivity[at], 1);
        put(pixel, frame.second_range[at] | flags, 3);
        put(pixel, frame.second_reflectivity[at], 1);
        put(pixel, 0x123456789abcdef0, 8);
    } else if (profile.name == "FIVE_WORD_PIXEL") {  // 19 bits of range, 5 of flags, 8, twice
        put(pixel, frame.range[at] | flags, 3);
        put(pixel, frame.reflectivity[at], 1);
        put(pixel, frame.second_range[at] | flags, 3);
        put(pixel, frame.second_reflectivity[at], 1);
        put(pixel, 0x123456789abcdef0, 8);
        put(pixel, 0xffffffff, 4);
    } else {  // RNG15_RFL8_NIR8 and extensions: 15 bits of range, 1 of flags, 8, 8
        put(pixel, frame.range[at] | 0x8000, 2);
        put(pixel, frame.reflectivity[at], 1);
        put(pixel, 0x77, 1);
        if (profile.name == "RNG15_RFL8_NIR8_ZONE16") {
            put(pixel, 0xffffffff, 4);
        } else if (profile.name == "RNG15_RFL8_NIR8_DUAL" ||
                   profile.name == "FUSA_RNG15_RFL8_NIR8_DUAL") {
            put(pixel, frame.second_range[at] | 0x8000, 2);
            put(pixel, frame.second_reflectivity[at], 1);
            put(pixel, 0x88, 1);
        }
    }
    bytes += pixel;
}

}  // namespace

std::string ousterJson(const std::string& profile, const std::string& serial) {
    return R"({"prod_line": "OS-0-32-U1", "prod_sn": ")" + serial + R"(",
        "beam_altitude_angles": [40.0, 15.0, -10.5, -45.0],
        "beam_azimuth_angles": [3.0, 1.0, -1.0, -3.0],
        "lidar_origin_to_beam_origin_mm": 27.67,
        "lidar_to_sensor_transform": [-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36.18, 0, 0, 0, 1],
        "lidar_mode": "512x10",
        "data_format": {"columns_per_frame": 64, "columns_per_packet": 16, "pixels_per_column": 4,
            "column_window": [0, 63], "udp_profile_lidar": ")" +
           profile + "\"}}";
}

std::vector<std::string> packetsOf(const sensors::OusterSensor& sensor,
                                   const sensors::OusterFrame& frame) {
    using Column = sensors::OusterFrame::Column;
    const bool is_legacy = sensor.profile.is_legacy;
    std::vector<std::string> packets;
    for (std::size_t first = 0; first < frame.columns; first += sensor.columns_per_packet) {
        std::string bytes;
        if (sensor.has_fusa_header) {
            put(bytes, 1, 1);
            put(bytes, 4711, 3);
            put(bytes, 0x70000u + frame.id, 4);
            put(bytes, 0x990099, 3);
            put(bytes, sensor.serial.empty() ? 0 : std::stoull(sensor.serial), 5);
            bytes += std::string(16, '\x55');
        } else if (!is_legacy) {
            put(bytes, 1, 2);
            put(bytes, frame.id, 2);
            put(bytes, 4711, 3);
            put(bytes, sensor.serial.empty() ? 0 : std::stoull(sensor.serial), 5);
            bytes += std::string(20, '\x55');
        }
        for (std::size_t c = first; c < first + sensor.columns_per_packet; ++c) {
            const bool is_valid = frame.state[c] == Column::Valid;
            put(bytes, frame.column_time_ns[c], 8);
            put(bytes, c, 2);
            put(bytes, is_legacy ? frame.id : (is_valid ? 1 : 0), 2);
            if (is_legacy) put(bytes, 88 * c, 4);
            for (std::size_t p = 0; p < sensor.pixels; ++p) {
                putPixel(bytes, sensor.profile, frame, frame.at(p, c));
            }
            if (is_legacy) put(bytes, is_valid ? 0xffffffff : 0, 4);
        }
        if (!is_legacy) bytes += std::string(32, '\x66');
        packets.push_back(bytes);
    }
    return packets;
}

sensors::OusterFrame randomFrame(const sensors::OusterSensor& sensor, std::uint16_t id) {
    Random random(id);
    sensors::OusterFrame frame;
    frame.id = id;
    frame.columns = sensor.columns_per_frame;
    frame.state.assign(frame.columns, sensors::OusterFrame::Column::Valid);
    for (std::size_t c = 0; c < frame.columns; ++c) {
        frame.column_time_ns.push_back(1000000000ull * id + 1000000 * c);
    }
    for (std::size_t i = 0; i < sensor.pixels * frame.columns; ++i) {
        const int max = static_cast<int>(sensor.profile.range_mask) / 4;
        frame.range.push_back(
            random.chance(0.2) ? 0 : static_cast<std::uint32_t>(random.whole(1, max)));
        frame.reflectivity.push_back(static_cast<std::uint8_t>(random.whole(0, 255)));
        if (sensor.profile.second_at == 0) continue;
        frame.second_range.push_back(
            random.chance(0.8) ? 0 : static_cast<std::uint32_t>(random.whole(1, max)));
        frame.second_reflectivity.push_back(static_cast<std::uint8_t>(random.whole(0, 255)));
    }
    return frame;
}

}  // namespace hagen::test
