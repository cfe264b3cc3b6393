#pragma once
#include <hagen/filter/HagenFilter.h>
#include <hagen/filter/SectorFilter.h>
#include <hagen/live/Thinning.h>
#include <hagen/live/TurnMotion.h>
#include <hagen/scan/Angle.h>
#include <hagen/scan/ColumnMap.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <hagen/sensors/Sweep.h>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace hagen::live {

/// Sector size and context. docs/live.md compares other values.
struct StreamingOptions {
    /// A sector ends with the last packet that fits into this angle; it has at least one packet.
    double sector_rad = 0.2617993877991494;  // 15 degrees
    /// Angle on both sides of a sector in which all returns of the latest turn are context.
    double window_rad = 0.08726646259971647;  // 5 degrees
    /// Elsewhere, every n-th image column is context (Thinning); 1 for all, 0 for none.
    int keep_every = 5;
    /// Estimate tilt and climb from the ground (TurnMotion) if tilt and pose are unknown.
    bool estimate_motion_from_ground = true;
    /// Returns ahead of the sector are almost a turn old. Skip those up to this angle (less than
    /// half a turn) if the sensor's motion since then is unknown, even from the ground, because
    /// tilted old ground looks like a step.
    double skip_ahead_rad = 0.4363323129985824;  // 25 degrees
    /// Like skip_ahead_rad, if motion, tilt or ground motion is known, because returns have other
    /// neighbours when seen from another position. Nothing is skipped if the sensor has not moved.
    double skip_ahead_moved_rad = 0.06981317007977318;  // 4 degrees
    /// Maximum age of context, because older returns precede a silence. Without a rotating head,
    /// the time labelled at once.
    double context_s = 0.25;
    /// Until the latest returns cover this angle, nothing in the zone is ROU, because too little
    /// ground is visible (docs/live.md). Without a rotating head, the angle's share of a turn
    /// applies to `context_s`.
    double min_known_rad = 3.141592653589793;
    /// Maximum duration of a sector if the sensor turns slowly.
    double longest_sector_s = 0.05;
};

using sensors::BeamOffsets;
using sensors::Sweep;

/// The returns of a sector with their labels. References are valid during the call only.
struct LabelledSector {
    const Scan& returns;               ///< as measured, in order of arrival
    const std::vector<Label>& label;   ///< label of each return
    std::optional<Sweep> sweep;        ///< nullopt without a rotating head
    double first_time_s, last_time_s;  ///< arrival of the first and last packet
    bool has_turn;                     ///< whether the context covers a full turn
    bool is_doubtful;                  ///< too little context, so all returns in the zone are RoI
    bool is_cut;                       ///< whether it was ended by flush() or restart()
    /// Result for the sector and its context. Only columns around the sector have images and labels
    /// (SectorFilter.h).
    const SegmentationResult& result;
    /// The sweep of each packet, with gaps if packets were lost; null if unknown.
    const std::vector<Sweep>* packets = nullptr;
    /// Measuring time without a rotating head; infinity for full coverage.
    double measured_s = std::numeric_limits<double>::infinity();
    BeamOffsets offsets = {};
    /// Start on the sensor clock without a rotating head; nullopt if unknown.
    std::optional<double> sensor_time_s = std::nullopt;
};

/// Labels the returns of a LiDAR sector by sector while it turns.
///
/// Runs SectorFilter on the latest turn with the new sector in place: all returns in a window
/// around the sector, and a selection of the other returns that shows the ground. Context ahead of
/// the sector is from the turn before. Almost all labels equal those of the whole scan. Sectors
/// without a previous turn use the available context, but everything in the zone is RoI until half
/// a turn is known, to be safe.
///
///     StreamingSegmenter segmenter(sensorModel("VLP-16"), {}, [&](const LabelledSector& sector) {
///         for (std::size_t i = 0; i < sector.returns.size(); ++i) ...
///     });
///     while (...) segmenter.add(returns_of_packet, sweep, arrival_s);
///
/// After the first turns, only the callback may allocate memory. Not thread-safe.
class StreamingSegmenter {
 public:
    using Take = std::function<void(const LabelledSector&)>;

    /// Throws std::invalid_argument if options and sensor do not match (checkOptions()), or if a
    /// streaming option is out of range, naming the option.
    StreamingSegmenter(SensorModel sensor, Options options, Take take,
                       const StreamingOptions& streaming = {});

    /// Sets the current tilt and pose of the sensor (map from sensor), if known. Context is moved
    /// by the pose change since it was measured, or, without poses, turned by the tilt change.
    /// Without both, tilt and climb of a rotating sensor are estimated from the ground
    /// (TurnMotion), or context stays as measured. nullopt and values that are not finite mean that
    /// the value is unknown.
    void setAttitude(const std::optional<Attitude>& attitude);
    void setPose(const std::optional<Eigen::Isometry3d>& map_from_sensor);
    /// Sets the sensor's tilt on a level vehicle, which the filter uses while the tilt is unknown.
    /// It does not describe motion. By default, there is none.
    void setMount(const std::optional<Attitude>& tilt);

    /// Sets the beam offsets: a direction is complete once all beams have passed it. By default,
    /// there are none. Throws std::invalid_argument unless both are between 0 and a full turn.
    void setBeamOffsets(const BeamOffsets& offsets);

    /// Sets the angle of a turn that the sensor sees, if its field of view is limited. The returns
    /// then suffice to find the ground once they cover most of it.
    void setView(double view_rad) { view_rad_ = view_rad; }

    /// Adds the returns of a packet, with ranges, azimuths and rows (checkLocated()), and its
    /// arrival time in seconds. Throws std::invalid_argument for invalid values. A late packet's
    /// `sweep` may precede earlier sweeps; its returns are labelled with the sector in progress.
    /// Calls the callback when a sector ends.
    void add(const Scan& returns, const Sweep& sweep, double time_s);
    /// Adds a frame of a sensor without a rotating head as a sector. `first_time_s` (default:
    /// `time_s`) and `time_s` are the arrival times of its first and last packet. `measured_s` is
    /// the measuring time of the received packets. `sensor_time_s` is the time of the first packet
    /// on the sensor clock.
    void addFrame(const Scan& returns, double time_s,
                  double measured_s = std::numeric_limits<double>::infinity(),
                  std::optional<double> first_time_s = std::nullopt,
                  std::optional<double> sensor_time_s = std::nullopt);
    /// Labels the sector in progress, for use when no packets arrive.
    void flush();
    /// Labels the sector in progress and clears the context, because the place or the sensor mode
    /// changes.
    void restart();

    std::size_t sectors() const { return sectors_; }
    const SensorModel& sensor() const { return filter_.sensor(); }
    const Options& options() const { return filter_.options(); }
    const StreamingOptions& streaming() const { return streaming_; }

 private:
    /// Returns, and the results of those that are already labelled.
    struct Returns {
        Scan scan;
        std::vector<ContextReturn> found;

        void clear();
        void append(const Returns& other, std::size_t i);
        void append(const Returns& other, std::size_t first, std::size_t end);
        void eraseFirst(std::size_t number);
    };
    struct Packet {
        Returns all;
        std::size_t thinned_first = 0, thinned_end = 0;  ///< range of its returns in `thinned_`
        std::optional<Sweep> sweep;
        double time_s = 0, first_time_s = 0;    ///< equal, except for frames
        std::optional<Eigen::Isometry3d> pose;  ///< of the sensor; without position, rotation only
        bool has_place = false;
        double measured_s = 0;  ///< measuring time, if there are no sweeps
        std::optional<double> sensor_time_s;
    };

    Packet& push(const Scan& returns, double time_s);
    void thin(Packet& packet);
    void forgetThinned();
    void forget(double now_s);
    void label(bool is_cut);
    std::optional<Attitude> tilt() const { return attitude_ ? attitude_ : mount_; }
    bool knowsEnough() const;
    void addContext(const Packet& packet, const Sweep& sector);
    std::optional<Eigen::Isometry3d> motionSince(const Packet& packet) const;
    void addMoved(const Returns& returns, std::size_t first, std::size_t end,
                  const Eigen::Isometry3d& motion, bool keeps_pixels);
    bool isOlderThanTurn(const Packet& packet) const;
    void addOlderTurn(const Packet& packet, const Sweep& sector,
                      const std::optional<Eigen::Isometry3d>& motion);
    void addAhead(const Returns& returns);
    void addThinned(std::size_t first, std::size_t end);
    bool mapWindow(const Sweep& sector);
    const SegmentationResult& judge();
    void keepFound();

    HagenFilter filter_;          ///< labels all visible returns at once
    SectorFilter sector_filter_;  ///< labels a sector with its context
    StreamingOptions streaming_;
    Thinning thinning_;
    TurnMotion turn_motion_;  ///< updated while neither tilt nor pose is known
    Take take_;
    int turns_;         ///< of the sliding window
    double max_age_s_;  ///< of context
    std::optional<Attitude> attitude_, mount_;
    BeamOffsets offsets_;
    double view_rad_ = kTurn_rad;
    std::optional<Eigen::Isometry3d> pose_;

    std::deque<Packet> packets_;  ///< packets of the latest turn, in order of arrival
    std::vector<Packet> spare_;   ///< reused packet buffers
    /// The returns used as context far from a sector. Those of successive packets are contiguous,
    /// because most sectors copy long stretches of them.
    Returns thinned_;
    std::size_t pending_first_ = 0, pending_end_ = 0;  ///< stretch to be added next
    std::size_t open_ = 0;                             ///< packets of the sector in progress
    double head_rad_ = 0;                              ///< rotation of the sensor
    double start_rad_ = 0;                             ///< start of the sector in progress
    std::size_t sectors_ = 0;
    Returns window_, moved_;  ///< reused; `moved_` for frames and older turns
    std::size_t latest_ = 0;  ///< returns of the latest turn, which begin `window_`
    ColumnMap columns_;       ///< reused
    Scan sector_;
    std::vector<Label> labels_;         ///< labels of the sector's returns
    std::vector<ContextReturn> found_;  ///< results of the sector's returns
    std::vector<Sweep> sweeps_;         ///< sweeps of the sector's packets
};

}  // namespace hagen::live
