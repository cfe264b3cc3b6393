#pragma once
#include <hagen/live/StreamingSegmenter.h>

#include <limits>
#include <optional>
#include <vector>

namespace hagen::live {

/// The directions that all beams of a rotating sensor have swept; some beams lag (BeamOffsets).
/// Between two packets, others may be lost, however narrow they are. Packets that come late close
/// the gap that they left.
class TurnCoverage {
 public:
    /// The directions that a packet's sweep has completed, in angles that grow from turn to turn.
    struct Swept {
        double from_rad, to_rad;
        double since_rad;  ///< without a gap from here to `to_rad`
    };

    /// Directions of the sensor, in any turn. NaN: none.
    struct Arc {
        double begin_rad, width_rad;
    };

    /// Between two directions less than half a turn apart, in any order: a sensor may be upside
    /// down.
    static Arc between(double a_rad, double b_rad);

    /// Adds the packets of a sector that has a sweep; valid until the next call.
    const std::vector<Swept>& add(const LabelledSector& sector);
    /// How far the sensor has turned, and how far it had before the latest sector. Unlike the
    /// angles of sectors, these continue after a restart of the sensor.
    double head_rad() const { return head_rad_; }
    double before_rad() const { return before_rad_; }
    void clear();

 private:
    static constexpr double kNone = -std::numeric_limits<double>::infinity();

    void add(const Sweep& sweep, const BeamOffsets& offsets);

    std::vector<Sweep> stretches_;  ///< without a gap, of the latest turn; in any order
    std::vector<Swept> swept_;
    double head_rad_ = kNone, before_rad_ = kNone;
    double added_rad_ = 0;  ///< to the angles of sectors
};

/// Where an arc ends in the latest turn in which the sweep has completed it; none: not all of the
/// arc was swept without a gap.
std::optional<double> endOfArc(const TurnCoverage::Swept& swept, const TurnCoverage::Arc& arc);

/// A later turn has passed what was seen when the head was at an angle if the end of its arc is
/// beyond it by this: the end of the same turn is at or before the head, also of packets that came
/// late, and that of the next one at least half a turn after it.
constexpr double kLaterTurn_rad = 1;

}  // namespace hagen::live
