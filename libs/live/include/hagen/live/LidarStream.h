#pragma once
#include <hagen/live/SensorMotion.h>
#include <hagen/live/StreamingSegmenter.h>
#include <hagen/sensors/LidarDriver.h>
#include <hagen/settings/Settings.h>

#include <cstddef>
#include <memory>

namespace hagen::live {

/// Labels the packets of one LiDAR as they arrive: sector by sector, or, for a sensor without a
/// rotating head, frame by frame with the returns of the last 0.1 s as context.
class LidarStream : private sensors::ReturnSink {
 public:
    /// Uses the options, range limits, airframe and mount of `settings`. Throws SettingsError if
    /// the options do not fit the sensor.
    LidarStream(std::unique_ptr<sensors::LidarDriver> driver, const Settings& settings,
                StreamingSegmenter::Take take, const StreamingOptions& streaming = {});

    /// Adds a datagram that arrived at `arrival_s`, in seconds of a monotonic clock. Throws
    /// std::invalid_argument unless the time is finite.
    sensors::Taken add(const sensors::Datagram& datagram, double arrival_s);
    /// Labels the sector in progress, for use when the sensor is silent.
    void flush() override;

    /// Sets the sensor's tilt and pose; see StreamingSegmenter. While the tilt is unknown, the
    /// mount's tilt on a level vehicle is used.
    void move(const SensorMotion& motion);

    sensors::LidarDriver& driver() { return *driver_; }
    const sensors::LidarDriver& driver() const { return *driver_; }
    const sensors::PacketCounts& counts() const { return driver_->counts(); }
    /// Number of returns masked as airframe.
    std::size_t returnsMasked() const { return returns_masked_; }
    const StreamingSegmenter& segmenter() const { return *segmenter_; }

 private:
    void add(Scan& returns, const sensors::Sweep& sweep, double arrival_s) override;
    void addFrame(Scan& returns, const Frame& frame) override;
    void restart() override { segmenter_->restart(); }

    std::unique_ptr<sensors::LidarDriver> driver_;
    Settings settings_;
    std::unique_ptr<StreamingSegmenter> segmenter_;
    std::size_t returns_masked_ = 0;
};

}  // namespace hagen::live
