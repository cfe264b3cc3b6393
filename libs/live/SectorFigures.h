#pragma once
#include <hagen/filter/ResultCheck.h>
#include <hagen/live/LiveSession.h>

#include <array>
#include <optional>
#include <string>

namespace hagen::live {

/// The last reported and the current motor speed, in turns per second.
struct RateChange {
    double before, now;
};

/// Computes the sector statistics of the report and of the half-second status.
class SectorFigures {
 public:
    /// Directions are relative to the vehicle; `mount` is the sensor's tilt on it.
    SectorFigures(const SensorModel& sensor, const Settings& settings, LiveReport& report);

    /// Adds a sector labelled at `now_s`.
    void take(const LabelledSector& sector, double now_s);
    /// Checks the labels of a turn per second. Not urgent: call it after passing the sector on.
    void checkTurn(const LabelledSector& sector);
    /// Counts the states of the directions, at 20 Hz.
    void countDirections(double now_s);
    /// Copies the latest distances into the report.
    void update(double now_s) { report_.latest = distances_.at(now_s); }

    /// The status of the last `passed_s`. For a sensor without a rotating head, angles are replaced
    /// by frames.
    LiveStatus status(double passed_s, bool turns) const;
    /// Returns a change of motor speed confirmed by two statuses, because packets may arrive in
    /// bursts.
    std::optional<RateChange> rateChange();
    /// Returns a warning if RoI returns stay within 1 m in the same direction for 10 s, as those of
    /// the vehicle itself do; empty otherwise.
    std::string airframeWarning(double now_s) const;
    /// Warnings about the labels of ten turns, one per second; empty until then.
    std::vector<std::string> resultWarnings() const;
    /// Resets status and rate.
    void next();

 private:
    void noteNearest(const LabelledSector& sector);

    LiveReport& report_;
    SensorModel sensor_;
    Options options_;
    Eigen::Matrix3f vehicle_from_sensor_;
    SectorDistances distances_;
    struct Near {
        double since_s = 0, last_s = -1e9;
        float nearest_m = 0;
    };
    std::array<Near, SectorDistances::kSectors> near_;
    ResultCheck check_{false};
    Scan turn_;  ///< returns of the turn to be checked, and their labels
    std::vector<Label> turn_labels_;
    std::size_t turns_checked_ = 0;
    double turn_from_s_ = 0;
    double counted_s_ = 0;
    LatencyHistogram recent_;
    double recent_sweep_rad_ = 0, recent_first_s_ = 0, recent_last_s_ = 0, reported_rate_ = 0;
    int odd_rates_ = 0;
};

}  // namespace hagen::live
