#pragma once
#include <hagen/streaming/FrameCoverage.h>
#include <hagen/streaming/StreamingSegmenter.h>
#include <hagen/streaming/TurnCoverage.h>
#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <vector>

namespace hagen::streaming {

/// The nearest obstacle in each direction around the vehicle, from labelled sectors, as protocols
/// of autopilots want it: 72 sectors of 5 degrees in the body frame (x forward, y left, z up).
///
/// **Stale is never free.** A direction that was not swept for 0.3 s is unknown, and so is one that
/// was swept in part: a lost packet leaves a gap, however narrow it is (TurnCoverage). "Seen
/// nothing" means that the sensor swept all of it, at the horizon of the body, and that none of the
/// returns is RoI. What an earlier turn saw is forgotten once a later one has passed all of the
/// sensor's degrees in which it was seen. A sensor that does not turn is taken to look all around
/// within each tenth of a second, if few of its packets are lost (FrameCoverage). What it saw is
/// forgotten once it has looked all around in a tenth of a second that began that much later. Where
/// that did not happen, the direction is unknown after 0.3 s.
class SectorDistances {
 public:
    static constexpr int kSectors = 72;

    enum class State { Unknown, SeenNothing, Obstacle };
    struct Sector {
        State state = State::Unknown;
        /// Horizontal distance of the nearest RoI return from the body's origin; NaN unless there
        /// is an obstacle. In a sector that is swept in part, a nearer one may be in the rest.
        float distance_m = std::numeric_limits<float>::quiet_NaN();
        /// When the oldest packet that this rests on came; -infinity if it is unknown.
        double time_s = -std::numeric_limits<double>::infinity();
    };

    struct Settings {
        Eigen::Isometry3f body_from_sensor = Eigen::Isometry3f::Identity();
        /// Obstacles are RoI returns between these heights above the body's origin.
        float low_m = -std::numeric_limits<float>::infinity();
        float high_m = std::numeric_limits<float>::infinity();
        double stale_s = 0.3;
    };

    /// `sensor` tells where its beams look: a sensor that is tilted so far that it does not see the
    /// body's horizon in a direction never sees nothing there.
    explicit SectorDistances(const SensorModel& sensor) : SectorDistances(sensor, Settings()) {}
    SectorDistances(const SensorModel& sensor, const Settings& settings);

    /// A clock that goes back does not tell how old the earlier sectors are: they are forgotten.
    void take(const LabelledSector& sector);

    /// Sector 0 begins straight ahead, at azimuth 0, and sectors run clockwise, as in MAVLink's
    /// OBSTACLE_DISTANCE with angle_offset 2.5 degrees: sector k is from 5 k to 5 (k + 1) degrees.
    /// Time is of the clock of the packets' arrival.
    std::array<Sector, kSectors> at(double now_s) const;

 private:
    static constexpr int kParts = 5;  ///< of a sector, a degree each
    static constexpr int kBins = kSectors * kParts;
    static constexpr double kNever = -std::numeric_limits<double>::infinity();
    /// The nearest RoI return of a turn, or of a frame.
    struct Found {
        double time_s = kNever, turned_rad = kNever;
        float distance_m = std::numeric_limits<float>::infinity();
        /// Of the sensor, in which it saw what is in the bin; they may go on beyond 0 and 359.
        int first_degree = 0, last_degree = 0;
    };
    /// Of a degree of the sensor: the end of the latest turn that swept all of it.
    struct Passed {
        double end_rad = kNever, time_s = kNever;
    };
    struct Bin {
        double begun_s = kNever, begun_rad = kNever;  ///< when a turn looked there first; its begin
        double swept_s = kNever;   ///< when the turn or period that swept all of it last began
        double end_rad = kNever;   ///< its end in that turn
        std::vector<Found> found;  ///< by turn, oldest first
    };

    void noteSwept(const LabelledSector& sector);
    static void noteSwept(const TurnCoverage::Swept& swept, const TurnCoverage::Arc& arc,
                          double now_s, Bin& bin);
    void forgetFound(double now_s, Bin& bin) const;
    bool isGone(const Found& found) const;
    bool isFresh(double time_s, double now_s) const;

    Settings settings_;
    /// Where the sensor sees the bins; NaN: not.
    std::array<TurnCoverage::Arc, kBins> arcs_{};
    std::array<Bin, kBins> bins_{};
    std::array<Passed, kBins> passed_{};  ///< by the sensor's degrees, clockwise from its ahead
    TurnCoverage coverage_;
    FrameCoverage frames_;
    double latest_s_ = kNever;
    // Without turns: when the last period that was measured began, and 2 pi per frame.
    double all_around_since_s_ = kNever, frames_rad_ = 0;
};

}  // namespace hagen::streaming
