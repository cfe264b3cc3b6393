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

/// The LiDAR's faults in a trial: 2 cm of noise, 1 % of returns lost, thin wires missed more often
/// with distance, and those of the air.
simulation::SensorErrorModel trialErrorModel(Air air);

/// The vehicle's own parts as its settings mask them: those of config/airframe_simulated.yaml. None
/// in clear air, where the sensor does not see them.
Airframe trialAirframe(Air air);

/// The LiDAR on board and the filter behind it: a VLP-16 that turns ten times a second, segmented
/// with the settings of config/vlp16.yaml. Returns from the vehicle itself are masked.
class TrialSensor {
 public:
    static constexpr double kTurn_s = 0.1;

    /// `zone_m`: of the filter, instead of the 20 m of those settings.
    TrialSensor(const Course& course, Air air, float zone_m = Options().zone_m);

    const SensorModel& sensor() const { return filter_.sensor(); }
    const Options& options() const { return filter_.options(); }

    /// The turn that starts at `number` * kTurn_s, measured from the true poses. Masked returns
    /// have no range. Depends on air, the course's seed and the number only, not on which other
    /// turns were measured.
    simulation::SimulatedScan measure(int number, const FlightTrace& trace) const;

    /// Some firings of that turn, as far as the trace has got when the last of them ends. Depends
    /// on air, seed, number and the first firing only.
    simulation::SimulatedScan measureFirings(int number, const simulation::FiringRange& firings,
                                             const FlightTrace& trace) const;

    /// Segments a turn, with the horizon of the believed attitude. Valid until the next call.
    const LabelledReturns& segment(int number, const simulation::SimulatedScan& measured,
                                   const FlightTrace& trace, PoseBelief& belief);

    /// Places each return with a range by the believed pose at its own time.
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
