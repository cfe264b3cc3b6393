#include "Autopilot.h"

#include <hagen/scan/Angle.h>
#include "base/NumberText.h"

#include <map>
#include <stdexcept>
#include <string>

namespace hagen {

using base::Flag;
using base::UsageError;

namespace {

/// The baud rate for all messages plus 10 %: directions at 20 Hz, obstacles and ground at 10 Hz. A
/// byte takes 10 bits.
int neededBaud(int obstacles) {
    constexpr int kBytes_s = 3900, kBytesOfObstacle_s = 400;
    return 11 * (kBytes_s + kBytesOfObstacle_s * obstacles);
}

}  // namespace

void declareAutopilot(base::Program& app, AutopilotFlags& flags) {
    const Flag peer =
        app.option("--mavlink", flags.peer,
                   "autopilot that receives obstacles and sends attitude and position: "
                   "udp:HOST:PORT[:OUR_PORT] or serial:DEVICE:BAUD (docs/autopilot.md)")
            .valueName("PEER")
            .group("Autopilot");
    app.option("--mavlink-system", flags.system, "MAVLink system ID")
        .between(1, 255)
        .showDefault()
        .valueName("N")
        .needs(peer)
        .group("Autopilot");
    app.option("--sensor-yaw", flags.sensor_yaw_deg,
               "yaw of the sensor's x axis from the vehicle's front, clockwise from above")
        .between(-360.0, 360.0)
        .showDefault()
        .valueName("DEG")
        .needs(peer)
        .group("Autopilot");
    app.option("--obstacle-height", flags.height_m,
               "max. height of obstacles above or below the sensor (default: unlimited)")
        .positive()
        .valueName("M")
        .needs(peer)
        .group("Autopilot");
    app.option("--obstacles", flags.nearest,
               "max. number of single obstacles (OBSTACLE_DISTANCE_3D)")
        .between(0, 20)
        .showDefault()
        .valueName("N")
        .needs(peer)
        .group("Autopilot");
    app.flag("--no-ground", flags.has_no_ground,
             "do not send the distance to the ground (DISTANCE_SENSOR)")
        .needs(peer)
        .group("Autopilot");
    app.flag("--simulated-vehicle", flags.is_simulated, "the vehicle's clock may pause or run slow")
        .needs(peer)
        .group("Autopilot");
}

void checkAutopilot(const AutopilotFlags& flags) {
    if (flags.peer.empty()) return;
    mavlink::PeerAddress peer;
    try {
        peer = mavlink::parsePeer(flags.peer);
    } catch (const std::runtime_error& e) {
        throw UsageError("--mavlink", e.what());
    }
    const int needed = neededBaud(flags.nearest);
    if (peer.kind == mavlink::PeerAddress::Kind::Serial && peer.baud < needed) {
        throw UsageError("--obstacles", std::to_string(flags.nearest) + " obstacles require " +
                                            std::to_string(needed) + " baud; --mavlink specifies " +
                                            std::to_string(peer.baud) +
                                            " (exceeds the bandwidth of the serial link)");
    }
}

Eigen::Matrix3d bodyFromSensor(const AutopilotFlags& flags, const Settings& settings) {
    const Eigen::AngleAxisd yaw(-radians(flags.sensor_yaw_deg), Eigen::Vector3d::UnitZ());
    return yaw * levelFromSensor(settings.mount).cast<double>();
}

std::unique_ptr<live::AutopilotLink> linkAutopilot(const AutopilotFlags& flags,
                                                   const Settings& settings,
                                                   live::LiveListener& listener) {
    if (flags.peer.empty()) return nullptr;
    live::AutopilotLink::Settings link;
    link.peer = mavlink::parsePeer(flags.peer);
    link.system = static_cast<std::uint8_t>(flags.system);
    link.has_ground = !flags.has_no_ground;
    link.is_simulated = flags.is_simulated;
    link.nearest = static_cast<std::size_t>(flags.nearest);
    link.directions.body_from_sensor.linear() = bodyFromSensor(flags, settings);
    if (flags.height_m) {
        link.directions.low_m = -*flags.height_m;
        link.directions.high_m = *flags.height_m;
    }
    auto opened = std::make_unique<live::AutopilotLink>(link, listener.remark);
    live::AutopilotLink* const to = opened.get();
    listener.begin = [to](const SensorModel& sensor, const Options& options) {
        to->begin(sensor, {options.zone_m, sensor.min_range_m});
    };
    listener.sector = [to](const live::LabelledSector& sector) { to->take(sector); };
    listener.motion = [to](double time_s) { return to->motionAt(time_s); };
    listener.counts["mavlink"] = [to] {
        to->stop();
        return to->counts();
    };
    return opened;
}

std::string summaryOf(const live::AutopilotLink& link) {
    std::map<std::string, std::size_t> n;
    for (const auto& [name, number] : link.counts()) n[name] = number;
    const std::size_t sent =
        n["obstacle_distance"] + n["obstacle_distance_3d"] + n["distance_sensor"] + n["heartbeat"];
    return "MAVLink: " + base::counted(sent, "message") + " sent (" +
           std::to_string(n["obstacle_distance"]) + " OBSTACLE_DISTANCE, " +
           std::to_string(n["all_unknown"]) + " with all directions unknown), " +
           std::to_string(n["not_sent"]) + " not sent; " + std::to_string(n["received"]) +
           " received, " + std::to_string(n["refused"] + n["bad_checksum"] + n["incompatible"]) +
           " refused\n";
}

}  // namespace hagen
