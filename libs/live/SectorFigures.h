#pragma once
#include <hagen/live/LiveSession.h>

#include <optional>

namespace hagen::live {

/// Expected and measured speed of the motor, in turns per second.
struct RateChange {
    double before, now;
};

/// What the report has of the sectors, and the status of the last half second.
class SectorFigures {
 public:
    /// Directions are of the vehicle, on which the sensor is tilted by `mount`.
    SectorFigures(const SensorModel& sensor, const Attitude& mount, LiveReport& report);

    /// A sector that got its labels at `now_s`.
    void take(const LabelledSector& sector, double now_s);
    /// Counts the states of the directions, each twentieth of a second.
    void countDirections(double now_s);
    /// The latest distances go into the report.
    void update(double now_s) { report_.latest = distances_.at(now_s); }

    /// Of `passed_s` until now. A sensor that does not turn has no angles: its frames count.
    LiveStatus status(double passed_s, bool turns) const;
    /// Whether the motor has another speed, twice in a row: packets may have come in a burst.
    std::optional<RateChange> rateChange();
    /// Begins anew with status and rate.
    void next();

 private:
    void noteNearest(const LabelledSector& sector);

    LiveReport& report_;
    Eigen::Matrix3f vehicle_from_sensor_;
    SectorDistances distances_;
    double counted_s_ = 0;
    LatencyHistogram recent_;
    double recent_sweep_rad_ = 0, recent_first_s_ = 0, recent_last_s_ = 0, rate_told_ = 0;
    int odd_rates_ = 0;
};

}  // namespace hagen::live
