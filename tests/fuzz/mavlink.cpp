// Arbitrary bytes from a MAVLink peer in parts of any size, and the motion decoded from them.
#include "live/autopilot/Messages.h"
#include "live/autopilot/VehicleMotion.h"
#include "live/mavlink/Parser.h"

#include <cmath>

#include "fuzz/Target.h"

namespace hagen::fuzz {
namespace {

void parse(std::string_view input) {
    Parts parts(input);
    mavlink::Parser parser;
    live::VehicleMotion motion;
    double time_s = 100;
    std::size_t taken = 0, bytes = 0;
    const auto take = [&](const mavlink::Frame& frame) {
        ++taken;
        motion.take(frame, time_s);
    };
    while (!parts.isAtEnd()) {
        const std::string_view part = parts.take(1 + parts.below(80));
        parser.add(reinterpret_cast<const std::uint8_t*>(part.data()), part.size(), take);
        bytes += part.size();
        if (parts.chance()) parser.end(take);
        time_s += 0.01;
        const auto pose = motion.at(time_s);
        if (!pose) continue;
        require(std::abs(pose->map_from_vehicle.norm() - 1) < 1e-3, "the attitude is no rotation");
        require(!pose->place_m || pose->place_m->allFinite(), "the place is not finite");
    }
    parser.end(take);
    const auto& counts = parser.counts();
    require(counts.messages == taken, "messages are counted wrong");
    require(counts.skipped_bytes + 8 * (taken + counts.incompatible) <= bytes,
            "more was read than there is");
}

template <class Message>
std::string bytesOf(const Message& message, std::uint8_t sequence) {
    mavlink::Frame frame = mavlink::frameOf(message);
    frame.sequence = sequence;
    frame.system = frame.component = 1;
    const auto bytes = mavlink::encode(frame, Message::kBytes);
    return {bytes.begin(), bytes.end()};
}

Seeds mavlinkSeeds() {
    mavlink::Attitude attitude;
    attitude.time_boot_ms = 1000;
    attitude.roll = 0.1f;
    attitude.yawspeed = 1;
    mavlink::AttitudeQuaternion quaternion;
    quaternion.time_boot_ms = 1010;
    quaternion.q1 = 1;
    quaternion.yawspeed = 0.5f;
    mavlink::LocalPositionNed place;
    place.time_boot_ms = 1020;
    place.x = 3;
    place.vz = -1;
    // A part consists of its size, the message, and whether the datagram ends.
    const auto part = [](const std::string& bytes) {
        return std::string(1, static_cast<char>(bytes.size() - 1)) + bytes + '\1';
    };
    const std::string messages =
        part(bytesOf(attitude, 0)) + part(bytesOf(quaternion, 1)) + part(bytesOf(place, 2));
    return {messages, messages + part("noise") + messages};
}

const bool kAdded = add({"mavlink", parse, mavlinkSeeds, {"\xfd", "\xfe"}, 2000});

}  // namespace
}  // namespace hagen::fuzz
