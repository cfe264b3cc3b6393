#pragma once
#include <hagen/live/LatencyHistogram.h>
#include <hagen/live/LiveSession.h>
#include <hagen/streaming/SectorDistances.h>
#include <hagen/streaming/StreamingSegmenter.h>

#include <string>

#include "LiveSensor.h"

namespace hagen::live {

/// What a listener is told of a sensor: sectors, changes, silence, and a status now and then.
class LiveReporter {
 public:
    /// All must outlive it.
    LiveReporter(const LiveOptions& options, const LiveListener& listener,
                 const LiveSensor& sensor);

    void datagram() { ++report_.datagrams; }
    /// A packet of the sensor was taken.
    void packet();
    void sector(const streaming::LabelledSector& sector);
    /// What the time brings: silence, the end of a recording, a status.
    void look(double now_s);
    /// All that came so far.
    LiveReport& report();

 private:
    void noteNearest(const streaming::LabelledSector& sector);
    void countDirections(double now_s);
    void tellRate();
    void showStatus(double now_s);

    const LiveOptions& options_;
    const LiveListener& listener_;
    const LiveSensor& sensor_;
    LiveReport report_;
    streaming::SectorDistances distances_;
    double start_s_, status_s_, counted_s_ = 0;
    bool is_silent_ = false, is_recording_told_ = false;
    LatencyHistogram recent_;  ///< since the last status
    double recent_sweep_rad_ = 0, recent_first_s_ = 0, recent_last_s_ = 0, rate_told_ = 0;
    int odd_rates_ = 0;
};

}  // namespace hagen::live
