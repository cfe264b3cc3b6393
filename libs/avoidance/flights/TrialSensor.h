#pragma once
#include <hagen/avoidance/Course.h>
#include <hagen/avoidance/FlightConditions.h>
#include <hagen/filter/HagenFilter.h>
#include <hagen/mrpt/MappedScan.h>
#include <hagen/scan/Airframe.h>
#include <hagen/simulation/Lidar.h>
#include "avoidance/flights/FlightTrace.h"
#include "avoidance/flights/PoseBelief.h"

namespace hagen::avoidance {

/// The LiDAR's errors in a trial: 2 cm of noise, 1 % of returns lost, thin wires missed more often
/// with distance, and the errors caused by the air.
simulation::SensorErrorModel trialErrorModel(Air air);

/// Mask of the vehicle's own parts, from config/airframe_simulated.yaml. Empty in clear air, where
/// the sensor does not see them.
Airframe trialAirframe(Air air);

/// The onboard LiDAR and its filter: a VLP-16 at 10 Hz, segmented with the settings of
/// config/vlp16.yaml. Returns from the vehicle itself are masked.
class TrialSensor {
 public:
    static constexpr double kTurn_s = 0.1;

    /// `zone_m`: range of the filter's zone, 20 m in config/vlp16.yaml.
    TrialSensor(const Course& course, Air air, float zone_m = Options().zone_m);

    const SensorModel& sensor() const { return filter_.sensor(); }
    const Options& options() const { return filter_.options(); }

    /// Measures the turn that starts at `number` * kTurn_s, from the true poses. Masked returns
    /// have no range. The result depends only on air, the course's seed and the number, not on
    /// previously measured turns.
    simulation::SimulatedScan measure(int number, const FlightTrace& trace) const;

    /// Like measure(), but only some firings; the trace must reach the last of them. The result
    /// depends only on air, seed, number and the first firing.
    simulation::SimulatedScan measureFirings(int number, const simulation::FiringRange& firings,
                                             const FlightTrace& trace) const;

    /// Segments a turn, levelled by the estimated attitude. Valid until the next call.
    const LabelledReturns& segment(int number, const simulation::SimulatedScan& measured,
                                   const FlightTrace& trace, PoseBelief& belief);

    /// Places the returns that have a range, using the estimated pose at the time of each.
    static observations::MappedScan place(int number, const simulation::SimulatedScan& measured,
                                          const LabelledReturns& returns, const FlightTrace& trace,
                                          PoseBelief& belief);

 private:
    const Course& course_;
    simulation::SensorErrorModel faults_;
    Airframe airframe_;
    HagenFilter filter_;
};

}  // namespace hagen::avoidance
