#pragma once
#include <hagen/live/StreamingSegmenter.h>

#include <limits>
#include <optional>
#include <vector>

namespace hagen::live {

/// The directions that all beams of a rotating sensor have swept; some beams lag (BeamOffsets).
/// Lost packets leave gaps, however narrow. Late packets close the gap.
class TurnCoverage {
 public:
    /// The directions completed by a packet's sweep, as angles that grow from turn to turn.
    struct Swept {
        double from_rad, to_rad;
        double since_rad;  ///< start of the gapless sweep up to `to_rad`
    };

    /// A range of azimuths in the sensor frame, modulo full turns; invalid if NaN.
    struct Arc {
        double begin_rad, width_rad;
    };

    /// The arc between two directions less than half a turn apart, in either order, because a
    /// sensor may be upside down.
    static Arc between(double a_rad, double b_rad);

    /// Adds the packets of a sector with a sweep; the result is valid until the next call.
    const std::vector<Swept>& add(const LabelledSector& sector);
    /// Rotation of the sensor after and before the latest sector. Unlike the angles of sectors,
    /// these values continue after a restart of the sensor.
    double head_rad() const { return head_rad_; }
    double before_rad() const { return before_rad_; }
    void clear();

 private:
    static constexpr double kNone = -std::numeric_limits<double>::infinity();

    void add(const Sweep& sweep, const BeamOffsets& offsets);

    std::vector<Sweep> stretches_;  ///< stretches without gaps within the latest turn; unordered
    std::vector<Swept> swept_;
    double head_rad_ = kNone, before_rad_ = kNone;
    double added_rad_ = 0;  ///< offset to the angles of sectors
};

/// The end of an arc in the latest turn that swept it completely; nullopt if no turn swept the
/// whole arc without a gap.
std::optional<double> endOfArc(const TurnCoverage::Swept& swept, const TurnCoverage::Arc& arc);

/// A later turn has passed an observation made at a head angle if its arc ends beyond that angle by
/// this much: in the same turn, the arc ends at or before the head, even for late packets; in the
/// next turn, at least half a turn after the head.
constexpr double kLaterTurn_rad = 1;

}  // namespace hagen::live
