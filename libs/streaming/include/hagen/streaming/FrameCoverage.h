#pragma once
#include <deque>

namespace hagen::streaming {

/// Whether a sensor that does not turn has looked all around: within a tenth of a second, if its
/// packets measured for most of it. Where packets are lost, nobody knows in which directions.
class FrameCoverage {
 public:
    static constexpr double kPeriod_s = 0.1, kLeastMeasured_s = 0.08;

    /// Adds a frame, by when it came and LabelledSector::measured_s. Returns whether the period
    /// that ends with it has been measured. A time before the last one begins anew.
    bool add(double time_s, double measured_s);

 private:
    struct Frame {
        double time_s, measured_s;
    };
    std::deque<Frame> frames_;  ///< of the period
};

}  // namespace hagen::streaming
