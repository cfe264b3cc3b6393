#pragma once
#include <deque>
#include <optional>

namespace hagen::live {

/// Decides whether a sensor without a rotating head has covered its field of view, which requires
/// that its packets measured for most of 0.1 s. The directions of lost packets are unknown.
class FrameCoverage {
 public:
    static constexpr double kPeriod_s = 0.1, kMinMeasured_s = 0.08;
    /// Earlier observations expire once a complete period has been measured that began this much
    /// later, because the scan pattern has then covered each direction again.
    static constexpr double kForgotten_s = kPeriod_s + 0.01;

    /// Adds a frame by its arrival time, LabelledSector::measured_s, and its time on the sensor
    /// clock (delayed packets arrive in bursts). If this frame completes a period, returns the
    /// arrival time of the period's first frame. If time goes back, starts over.
    std::optional<double> add(double time_s, double measured_s,
                              std::optional<double> sensor_time_s = std::nullopt);

 private:
    struct Frame {
        double time_s, sensor_time_s, measured_s;
    };
    std::deque<Frame> frames_;  ///< frames of the current period
};

}  // namespace hagen::live
