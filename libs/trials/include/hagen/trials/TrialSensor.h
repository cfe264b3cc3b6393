#pragma once
#include <hagen/mapping/MappedScan.h>
#include <hagen/segmentation/HagenFilter.h>
#include <hagen/simulation/Lidar.h>
#include <hagen/trials/Course.h>
#include <hagen/trials/FlightTrace.h>
#include <hagen/trials/PoseBelief.h>

namespace hagen::trials {

/// The LiDAR on board and the filter behind it: a VLP-16 that turns ten times a second, segmented
/// with the settings of config/vlp16.yaml.
class TrialSensor {
 public:
    static constexpr double kTurn_s = 0.1;

    explicit TrialSensor(const Course& course);

    /// The turn that starts at `number` * kTurn_s, measured from the true poses. Depends on the
    /// course's seed and the number only, not on which other turns were measured.
    simulation::SimulatedScan measure(int number, const FlightTrace& trace) const;

    /// Segments a turn, with the horizon of the believed attitude. Valid until the next call.
    const LabelledReturns& segment(int number, const simulation::SimulatedScan& measured,
                                   const FlightTrace& trace, PoseBelief& belief);

    /// Places each return with a range by the believed pose at its own time.
    static mapping::MappedScan place(int number, const simulation::SimulatedScan& measured,
                                     const LabelledReturns& returns, const FlightTrace& trace,
                                     PoseBelief& belief);

 private:
    const Course& course_;
    HagenFilter filter_;
};

}  // namespace hagen::trials
