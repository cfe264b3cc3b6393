#pragma once
#include <hagen/live/StreamingSegmenter.h>
#include <hagen/mrpt/MappedScan.h>
#include <hagen/simulation/Lidar.h>
#include <deque>
#include <vector>
#include "avoidance/flights/TrialSensor.h"

namespace hagen::avoidance {

/// The LiDAR of TrialSensor, labelled while it turns: packets of 24 firings are passed to a
/// StreamingSegmenter, with the estimated pose and tilt, as an autopilot would report them. The
/// last packet of a turn has the remaining 9 firings.
class SectorSensor {
 public:
    SectorSensor(const Course& course, Air air, float zone_m = Options().zone_m);
    SectorSensor(const SectorSensor&) = delete;
    SectorSensor& operator=(const SectorSensor&) = delete;

    /// Measures from the end of the last call to `time_s`, along the trace, which must reach that
    /// far. Returns the sectors completed meanwhile, oldest first, with returns placed as by
    /// TrialSensor::place(), without obstacle numbers.
    std::vector<observations::MappedScan> measureUntil(double time_s, const FlightTrace& trace,
                                                       PoseBelief& belief);

 private:
    /// A measured return that is not in a sector yet.
    struct Measured {
        int turn;
        float since_start_s;  ///< since the start of its turn
    };
    struct Labelled {
        Scan returns;
        std::vector<Label> label;
        live::Sweep sweep;
        double end_s;
    };

    simulation::FiringRange firingsOf(int packet) const;
    double endOf_s(int turn, int packet) const;
    void addPackets(int turn, int first, int end, const FlightTrace& trace, PoseBelief& belief);
    observations::MappedScan place(const Labelled& sector, const FlightTrace& trace,
                                   PoseBelief& belief);

    TrialSensor sensor_;
    simulation::FiringPattern pattern_;
    live::StreamingSegmenter segmenter_;
    int turn_ = 0, packet_ = 0;  ///< next to measure
    std::deque<Measured> measured_;
    std::vector<Labelled> labelled_;
};

/// Joins consecutive sectors.
observations::MappedScan joined(const std::vector<observations::MappedScan>& sectors);

}  // namespace hagen::avoidance
