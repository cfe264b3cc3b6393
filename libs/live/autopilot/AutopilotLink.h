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
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hagen::live {

/// Sends obstacle distances to an autopilot and receives the vehicle's motion: 20 times per
/// second OBSTACLE_DISTANCE, 10 times the nearest obstacles (OBSTACLE_DISTANCE_3D) and the ground
/// below (DISTANCE_SENSOR), once HEARTBEAT.
///
/// A thread of its own sends. If the one that labels stalls, or the sensor falls silent, it sends
/// "unknown" for all directions after 0.3 s, no ground and a critical state, and reports it.
/// Functions may be called by any thread. Times are of std::chrono::steady_clock, in seconds.
class AutopilotLink {
 public:
    struct Settings {
        mavlink::PeerAddress peer;
        std::uint8_t system = 1;    ///< of the vehicle, and ours
        std::size_t nearest = 5;    ///< obstacles that are sent one by one
        bool has_ground = true;     ///< whether the ground below is sent
        bool is_simulated = false;  ///< the vehicle's clock may pause, or be slower than ours
        SectorDistances::Settings directions = aheadFirst();
    };
    /// Counts of sent and received messages by name.
    using Counts = std::vector<std::pair<std::string, std::size_t>>;
    /// Called by the thread that sends.
    using Remark = std::function<void(const std::string&)>;

    /// Throws std::runtime_error naming the peer if it cannot be opened.
    AutopilotLink(Settings settings, Remark remark);
    /// The last message says that nothing is known.
    ~AutopilotLink();
    AutopilotLink(const AutopilotLink&) = delete;
    AutopilotLink& operator=(const AutopilotLink&) = delete;

    /// Begins to send. `limits.nearest_m` is taken from the sensor.
    void begin(const SensorModel& sensor, Limits limits);
    /// Takes the sectors of the sensor. Requires begin().
    void take(const LabelledSector& sector);
    /// The sensor's motion as reported by the autopilot.
    SensorMotion motionAt(double time_s) const;
    /// Sends for the last time.
    void stop();
    Counts counts() const;

 private:
    class Work;
    std::unique_ptr<Work> work_;
};

}  // namespace hagen::live
