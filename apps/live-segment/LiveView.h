#pragma once
#include <hagen/live/LiveSession.h>
#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <string>
#include "live/Directions.h"

namespace hagen {

/// Serves the viewer's page (docs/view.md) over HTTP: the returns of the latest turn, the
/// directions sent to the autopilot, latency and losses, ten times per second. Its threads have the
/// lowest priority, and a slow client misses frames.
class LiveView {
 public:
    struct Settings {
        std::string address;  ///< "8080" (this computer only) or "192.168.1.7:8080"
        std::string heading;
        /// For directions without an autopilot.
        live::SectorDistances::Settings directions = live::aheadFirst();
        /// Returns the directions sent to the autopilot; empty without one. Called by take().
        std::function<live::Directions()> directions_sent;
        std::function<live::SensorMotion()> motion;  ///< empty if unknown; called by take()
    };

    /// Throws std::runtime_error naming the address if it is not valid or in use.
    explicit LiveView(Settings settings);
    ~LiveView();
    LiveView(const LiveView&) = delete;
    LiveView& operator=(const LiveView&) = delete;

    /// To be called by the labelling thread, from the listener. Never blocks. Without clients,
    /// take() and show() return at once.
    void begin(const SensorModel& sensor, const Options& options);
    void take(const live::LabelledSector& sector);
    void show(const live::LiveReport& report, const live::LiveStatus& status,
              const std::string& autopilot);

 private:
    class Work;
    std::unique_ptr<Work> work_;
};

}  // namespace hagen
