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

    /// The turn from `number` * kTurn_s on, as it is measured from the true poses; depends on the
    /// course's seed and the number, not on what other turns were asked for.
    simulation::SimulatedScan measure(int number, const FlightTrace& trace) const;

    /// Segments it, its horizon that of the believed attitude. Valid until the next call.
    const std::vector<Label>& segment(int number, const simulation::SimulatedScan& measured,
                                      const FlightTrace& trace, PoseBelief& belief);

    /// Each return of the sensor's range at the believed pose of its own time.
    mapping::MappedScan place(int number, const simulation::SimulatedScan& measured,
                              const std::vector<Label>& labels, const FlightTrace& trace,
                              PoseBelief& belief) const;

 private:
    const Course& course_;
    HagenFilter filter_;
};

}  // namespace hagen::trials
