#pragma once
#include <hagen/filter/HagenFilter.h>
#include <hagen/filter/SectorFilter.h>
#include <hagen/live/Thinning.h>
#include <hagen/live/TurnMotion.h>
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
    /// A sector ends with the last packet that fits into this angle; it has at least one.
    double sector_rad = 0.2617993877991494;  // 15 degrees
    /// Context on both sides of a sector: all returns of the latest turn.
    double window_rad = 0.08726646259971647;  // 5 degrees
    /// Context elsewhere: every n-th image column (Thinning); 1: all, 0: none.
    int keep_every = 5;
    /// Without tilt and pose, estimate tilt and climb from the ground (TurnMotion).
    bool estimate_motion_from_ground = true;
    /// Returns ahead of the sector are almost a turn old. Those up to this angle are skipped if the
    /// sensor's motion since then is unknown, even from the ground: tilted old ground looks like a
    /// step. Less than half a turn.
    double skip_ahead_rad = 0.4363323129985824;  // 25 degrees
    /// The same if motion, tilt or ground motion is known: from another position, returns have
    /// other neighbours. Nothing is skipped if the sensor has not moved.
    double skip_ahead_moved_rad = 0.06981317007977318;  // 4 degrees
    /// Maximum age of context: older returns precede a silence. Without a rotating head, the time
    /// labelled at once.
    double context_s = 0.25;
    /// Until the latest returns cover this angle, nothing in the zone is ROU, because too little
    /// ground is visible (docs/live.md). Without a rotating head, the angle's share of a turn
    /// applies to `context_s`.
    double min_known_rad = 3.141592653589793;
    /// Maximum duration of a sector, however slowly the sensor turns.
    double longest_sector_s = 0.05;
};

using sensors::BeamOffsets;
using sensors::Sweep;

/// The returns of a sector with their labels. References are valid during the call only.
struct LabelledSector {
    const Scan& returns;               ///< in order of arrival, as measured
    const std::vector<Label>& label;   ///< one per return
    std::optional<Sweep> sweep;        ///< nullopt without a rotating head
    double first_time_s, last_time_s;  ///< arrival of its first and last packet
    bool has_turn;                     ///< whether the context covers a full turn
    bool is_doubtful;                  ///< all returns in the zone are RoI: too little context
    bool is_cut;                       ///< ended by flush() or restart()
    /// Result for the sector and its context. Only columns around the sector have images and labels
    /// (SectorFilter.h).
    const SegmentationResult& result;
    /// The sweep of each packet; with gaps if packets were lost. Null: unknown.
    const std::vector<Sweep>* packets = nullptr;
    /// Without a rotating head: measuring time. Infinity: full coverage.
    double measured_s = std::numeric_limits<double>::infinity();
    BeamOffsets offsets = {};
    /// Without a rotating head: start on the sensor clock. nullopt: unknown.
    std::optional<double> sensor_time_s = std::nullopt;
};

/// Labels the returns of a LiDAR sector by sector while it turns.
///
/// Runs SectorFilter on the latest turn with the new sector in place: all returns in a window
/// around the sector, and a selection of the others that shows the ground. Context ahead of the
/// sector is from the turn before. Almost all labels equal those of the whole scan. Sectors without
/// a previous turn use the available context, but everything in the zone is RoI until half a turn
/// is known: doubt is RoI, as in the filter.
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

    /// Throws std::invalid_argument if options and sensor do not match (checkOptions()), or naming
    /// a streaming option that is out of range.
    StreamingSegmenter(SensorModel sensor, Options options, Take take,
                       const StreamingOptions& streaming = {});

    /// Sets the current tilt and pose of the sensor (map from sensor), if known. Context is moved
    /// by the pose change since it was measured, or, without poses, turned by the tilt change.
    /// Without both, tilt and climb of a rotating sensor are estimated from the ground
    /// (TurnMotion), or context stays as measured. nullopt and values that are not finite mean
    /// unknown.
    void setAttitude(const std::optional<Attitude>& attitude);
    void setPose(const std::optional<Eigen::Isometry3d>& map_from_sensor);
    /// Sets the sensor's tilt on a level vehicle, which the filter uses while the tilt is unknown.
    /// Does not describe motion. Default: none.
    void setMount(const std::optional<Attitude>& tilt);

    /// Sets the beam offsets: a direction is complete once all beams have passed it. Default: none.
    /// Throws std::invalid_argument unless both are between 0 and a full turn.
    void setBeamOffsets(const BeamOffsets& offsets);

    /// Adds the returns of a packet, with ranges, azimuths and rows (checkLocated()), and its
    /// arrival time in seconds of any clock. Throws std::invalid_argument for invalid values. A
    /// late packet's `sweep` may precede earlier ones: its returns are labelled with the sector in
    /// progress. Calls the callback when a sector ends.
    void add(const Scan& returns, const Sweep& sweep, double time_s);
    /// Adds a frame of a sensor without a rotating head as a sector. `time_s`: arrival of its last
    /// packet. `measured_s`: measuring time of its packets; lost ones reduce it. `first_time_s`:
    /// arrival of its first packet (default: of the last). `sensor_time_s`: time of the first
    /// packet on the sensor clock.
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
    /// Returns, with the results of those already labelled.
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
        std::size_t thinned_first = 0, thinned_end = 0;  ///< in `thinned_`
        std::optional<Sweep> sweep;
        double time_s = 0, first_time_s = 0;    ///< the same, except for frames
        std::optional<Eigen::Isometry3d> pose;  ///< of the sensor; without position: rotation only
        bool has_place = false;
        double measured_s = 0;  ///< without sweeps
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
    void addAhead(const Returns& returns);
    void addThinned(std::size_t first, std::size_t end);
    bool mapWindow(const Sweep& sector);
    const SegmentationResult& judge();
    void keepFound();

    HagenFilter filter_;          ///< for all visible returns at once
    SectorFilter sector_filter_;  ///< for a sector and its context
    StreamingOptions streaming_;
    Thinning thinning_;
    TurnMotion turn_motion_;  ///< updated while neither tilt nor pose is known
    Take take_;
    std::optional<Attitude> attitude_, mount_;
    BeamOffsets offsets_;
    std::optional<Eigen::Isometry3d> pose_;

    std::deque<Packet> packets_;  ///< of the latest turn, in order of arrival
    std::vector<Packet> spare_;   ///< reused packet buffers
    /// Context returns far from a sector, packet by packet: most sectors use long stretches of it.
    Returns thinned_;
    std::size_t pending_first_ = 0, pending_end_ = 0;  ///< stretch to be added next
    std::size_t open_ = 0;                             ///< last packets: sector in progress
    double head_rad_ = 0;                              ///< rotation of the sensor
    double start_rad_ = 0;                             ///< start of the sector in progress
    std::size_t sectors_ = 0;
    Returns window_, moved_;  ///< reused; moved_: frames only
    ColumnMap columns_;       ///< reused
    Scan sector_;
    std::vector<Label> labels_;         ///< of the sector's returns
    std::vector<ContextReturn> found_;  ///< of the sector's returns
    std::vector<Sweep> sweeps_;         ///< of the sector's packets
};

}  // namespace hagen::live
