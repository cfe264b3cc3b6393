#pragma once
#include <hagen/live/SensorMotion.h>
#include <hagen/live/StreamingSegmenter.h>
#include <hagen/scan/SensorModel.h>
#include "live/Directions.h"
#include "live/autopilot/ObstacleMessages.h"
#include "live/autopilot/VehicleMotion.h"
#include "live/mavlink/Peer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hagen::live {

/// Sends obstacle distances to an autopilot and receives the vehicle's motion. Sends
/// OBSTACLE_DISTANCE at 20 Hz, the nearest obstacles (OBSTACLE_DISTANCE_3D) and the ground below
/// (DISTANCE_SENSOR) at 10 Hz, and HEARTBEAT at 1 Hz.
///
/// Runs its own sending thread. If labelling stalls or the sensor is silent for 0.3 s, the link
/// sends all directions as unknown, no ground and a critical state, and reports the stall. All
/// functions are thread-safe. Times are std::chrono::steady_clock seconds.
class AutopilotLink {
 public:
    struct Settings {
        mavlink::PeerAddress peer;
        std::uint8_t system = 1;    ///< MAVLink system ID
        std::size_t nearest = 5;    ///< number of obstacles sent individually
        bool has_ground = true;     ///< whether the ground below is sent
        bool is_simulated = false;  ///< the vehicle's clock may pause or run slow
        SectorDistances::Settings directions = aheadFirst();
    };
    /// Numbers of sent and received messages by name.
    using Counts = std::vector<std::pair<std::string, std::size_t>>;
    /// Called by the sending thread.
    using Remark = std::function<void(const std::string&)>;

    /// Throws std::runtime_error naming the peer if it cannot be opened.
    AutopilotLink(Settings settings, Remark remark);
    /// Sends a last message with all directions unknown.
    ~AutopilotLink();
    AutopilotLink(const AutopilotLink&) = delete;
    AutopilotLink& operator=(const AutopilotLink&) = delete;

    /// Starts sending. `limits.nearest_m` is overwritten with the sensor's minimum range.
    void begin(const SensorModel& sensor, Limits limits);
    /// Adds a labelled sector. Requires begin().
    void take(const LabelledSector& sector);
    /// The sensor's motion, computed from the autopilot's messages.
    SensorMotion motionAt(double time_s) const;
    /// Sends a last message with all directions unknown, and stops the thread.
    void stop();
    Counts counts() const;
    /// A short text for a status line: "ok", or the problem.
    std::string state() const;
    /// The directions sent last; all unknown before the first message.
    Directions directions() const;

 private:
    class Work;
    std::unique_ptr<Work> work_;
};

}  // namespace hagen::live
