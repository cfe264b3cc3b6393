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

/// Sends obstacles to an autopilot and receives the vehicle's motion: OBSTACLE_DISTANCE at 20 Hz,
/// the nearest obstacles (OBSTACLE_DISTANCE_3D) and the ground below (DISTANCE_SENSOR) at 10 Hz,
/// HEARTBEAT at 1 Hz.
///
/// A separate thread sends. If the labelling thread stalls or the sensor falls silent, it sends
/// "unknown" for all directions after 0.3 s, no ground and a critical state, and reports it. All
/// functions are thread-safe. Times are of std::chrono::steady_clock, in seconds.
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
    /// What was sent and received so far, by name.
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
    /// How the sensor moves, as far as the autopilot tells.
    SensorMotion motionAt(double time_s) const;
    /// Sends for the last time.
    void stop();
    Counts counts() const;

 private:
    class Work;
    std::unique_ptr<Work> work_;
};

}  // namespace hagen::live
