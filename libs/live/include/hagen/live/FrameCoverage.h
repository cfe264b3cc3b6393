#pragma once
#include <deque>
#include <optional>

namespace hagen::live {

/// Whether a sensor that does not turn has looked all around: within a tenth of a second, if its
/// packets measured for most of it. The directions of lost packets are unknown.
class FrameCoverage {
 public:
    static constexpr double kPeriod_s = 0.1, kMinMeasured_s = 0.08;
    /// What was seen is forgotten once a period has been measured that began so much later: it
    /// looked there again, and the pattern of the beams had time for a second look.
    static constexpr double kForgotten_s = kPeriod_s + 0.01;

    /// Adds a frame, by when it came, LabelledSector::measured_s, and when it was measured by the
    /// sensor's clock: packets that waited in a network come at once. If the period that ends with
    /// it has been measured, returns when its first frame came. A time before the last one begins
    /// anew.
    std::optional<double> add(double time_s, double measured_s,
                              std::optional<double> sensor_time_s = std::nullopt);

 private:
    struct Frame {
        double time_s, sensor_time_s, measured_s;
    };
    std::deque<Frame> frames_;  ///< of the period
};

}  // namespace hagen::live
