#pragma once
#include "sensors/ouster/OusterSensor.h"

#include "support/OusterPackets.h"

namespace hagen::test {

/// An Ouster mode such as "1024x10".
struct OusterMode {
    std::size_t columns = 1024;
    int turns_per_s = 10;

    std::string text() const { return std::to_string(columns) + "x" + std::to_string(turns_per_s); }
};

/// Metadata (ousterJson()) for a mode.
inline std::string ousterJsonOf(const OusterMode& mode,
                                const std::string& profile = "RNG19_RFL8_SIG16_NIR16") {
    std::string json = ousterJson(profile);
    const auto replace = [&](const std::string& from, const std::string& to) {
        json.replace(json.find(from), from.size(), to);
    };
    replace("512x10", mode.text());
    replace("\"columns_per_frame\": 64", "\"columns_per_frame\": " + std::to_string(mode.columns));
    replace("[0, 63]", "[0, " + std::to_string(mode.columns - 1) + "]");
    return json;
}

/// A rotating Ouster whose mode may change.
class TurningOuster {
 public:
    explicit TurningOuster(const std::string& profile = "RNG19_RFL8_SIG16_NIR16")
        : profile_(profile) {}

    std::vector<std::string> turn(const OusterMode& mode) {
        const sensors::OusterSensor sensor =
            sensors::ousterSensorOf(ousterJsonOf(mode, profile_), "test");
        sensors::OusterFrame frame = randomFrame(sensor, id_++);
        const double turn_ns = 1e9 / mode.turns_per_s;
        for (std::size_t c = 0; c < mode.columns; ++c) {
            const double since_ns =
                turn_ns * static_cast<double>(c) / static_cast<double>(mode.columns);
            frame.column_time_ns[c] = time_ns_ + static_cast<std::uint64_t>(since_ns);
        }
        time_ns_ += static_cast<std::uint64_t>(turn_ns);
        std::vector<std::string> packets = packetsOf(sensor, frame);
        for (std::size_t p = 0; p < packets.size(); ++p) {
            auto* const bytes = reinterpret_cast<std::uint8_t*>(packets[p].data());
            if (!sensor.profile.is_legacy) {
                bytes[sensor.has_fusa_header ? 1 : 4] = initialization;
                continue;
            }
            for (std::size_t c = 0; c < sensor.columns_per_packet; ++c) {  // encoder angle
                const std::size_t column = p * sensor.columns_per_packet + c;
                const auto angle = static_cast<std::uint32_t>(90112 / mode.columns * column);
                std::uint8_t* const at = bytes + c * sensor.columnBytes() + 12;
                for (int i = 0; i < 4; ++i) at[i] = static_cast<std::uint8_t>(angle >> (8 * i));
            }
        }
        return packets;
    }
    void setClock(std::uint64_t time_ns) { time_ns_ = time_ns; }

    std::uint8_t initialization = 7;

 private:
    std::string profile_;
    std::uint16_t id_ = 65530;
    std::uint64_t time_ns_ = 1000000000;
};

}  // namespace hagen::test
