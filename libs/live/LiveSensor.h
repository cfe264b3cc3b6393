#pragma once
#include <hagen/live/LiveSession.h>
#include <hagen/live/PacketQueue.h>
#include <hagen/live/SensorMotion.h>
#include <hagen/live/StreamingSegmenter.h>

#include <cstddef>
#include <memory>

namespace hagen::live {

/// A sensor of any maker: its packets become labelled sectors.
class LiveSensor {
 public:
    /// Of its packets, as in LiveReport.
    struct Counts {
        std::size_t packets = 0, lost = 0, late = 0, repeated = 0, wrong_size = 0, position = 0,
                    foreign = 0, unsound = 0, unsound_blocks = 0, too_late = 0, uncertain = 0,
                    restarts = 0, interruptions = 0, mode_changes = 0, scans = 0;
    };

    virtual ~LiveSensor() = default;

    virtual const live::StreamingSegmenter& segmenter() const = 0;
    /// False for a sensor that does not turn.
    virtual bool turns() const { return true; }
    virtual Counts counts() const = 0;
    /// Whether it sends two returns per firing now.
    virtual bool isDual() const { return false; }

    /// Whether a packet holds data of such a sensor.
    virtual bool isData(const Packet& packet) const = 0;
    /// Whether only the packet's address tells that it is of another sensor: it is of this model,
    /// and has no serial number.
    virtual bool isToldByAddress(const Packet& packet) const = 0;
    /// Whether the packet was taken.
    virtual bool add(const Packet& packet) = 0;
    virtual void move(const live::SensorMotion& motion) = 0;
    /// Labels what has come.
    virtual void flush() = 0;
    /// Completes the turn in progress, which counts.
    virtual void finish() {}
};

/// Throws std::runtime_error naming the file of metadata or calibration that cannot be used, and
/// SettingsError.
std::unique_ptr<LiveSensor> makeLiveSensor(const LiveOptions& options,
                                           const live::StreamingSegmenter::Take& take);

}  // namespace hagen::live
