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

/// How a turn is cut, and what a sector is judged by. docs/live.md has what other values cost.
struct StreamingOptions {
    /// A sector ends with the last packet that still fits into this angle; it has at least one.
    double sector_rad = 0.2617993877991494;  // 15 degrees
    /// Context on both sides of a sector: all returns of the latest turn.
    double window_rad = 0.08726646259971647;  // 5 degrees
    /// Context beyond: each n-th column of the image (Thinning); 1: all, 0: none.
    int keep_every = 5;
    /// Without tilt and pose, estimates tilt and climb from the ground (TurnMotion).
    bool estimate_motion_from_ground = true;
    /// Ahead of the sector, returns are almost a turn old. If it is unknown how the sensor has
    /// moved since, not even the ground, those up to this angle are no context: ground that is
    /// tilted against that of the sector looks like a step. Less than half a turn.
    double skip_ahead_rad = 0.4363323129985824;  // 25 degrees
    /// The same if its motion is known, or its tilt, or what the ground tells: what is seen from
    /// elsewhere has other neighbours. None are left out if nothing has changed by that.
    double skip_ahead_moved_rad = 0.06981317007977318;  // 4 degrees
    /// Returns older than this are no context: the sensor was silent. For a sensor that does not
    /// turn, the time that is judged at once.
    double context_s = 0.25;
    /// Until the latest returns cover this angle, nothing in the zone is ROU: too little ground is
    /// in sight to tell (docs/live.md). For a sensor that does not turn: this share of a turn is
    /// the share of `context_s`.
    double least_known_rad = 3.141592653589793;
    /// A sector ends at the latest after this time, however slowly the sensor turns.
    double longest_sector_s = 0.05;
};

using sensors::BeamOffsets;
using sensors::Sweep;

/// The returns of a sector with their labels. References are valid during the call only.
struct LabelledSector {
    const Scan& returns;               ///< in the order in which they came, as measured
    const std::vector<Label>& label;   ///< one per return
    std::optional<Sweep> sweep;        ///< none: of a sensor that does not turn
    double first_time_s, last_time_s;  ///< arrival of its first and last packet
    bool has_turn;                     ///< whether the rest of a turn was known
    bool is_doubtful;                  ///< all in the zone is RoI: too little of a turn was known
    bool is_cut;                       ///< ended by flush() or restart()
    /// Of the sector and its context; its images have all columns around the sector only, and
    /// labels in these (SectorFilter.h).
    const SegmentationResult& result;
    /// The sweep of each packet; less than `sweep` if one is lost. Null: unknown.
    const std::vector<Sweep>* packets = nullptr;
    /// Of a sensor that does not turn: for how long it measured. Infinity: it looked all around.
    double measured_s = std::numeric_limits<double>::infinity();
    BeamOffsets offsets = {};
    /// Of a sensor that does not turn: when it began, by a clock of the sensor. None: not known.
    std::optional<double> sensor_time_s = std::nullopt;
};

/// Labels the returns of a LiDAR sector by sector, while it turns.
///
/// It runs SectorFilter on the latest turn with the new sector in its place: on all returns in a
/// window around the sector, and on some of the others, which show where the ground is. On the
/// leading side, those are of the turn before. Labels are those of the whole scan but for a few.
/// Without a turn before, sectors are judged by the available context, but all in the zone is RoI
/// until half a turn is known: doubt is RoI, as in the filter.
///
///     StreamingSegmenter segmenter(sensorModel("VLP-16"), {}, [&](const LabelledSector& sector) {
///         for (std::size_t i = 0; i < sector.returns.size(); ++i) ...
///     });
///     while (...) segmenter.add(returns_of_packet, sweep, arrival_s);
///
/// No allocation after the first turns but for those of the function. Not thread-safe.
class StreamingSegmenter {
 public:
    using Take = std::function<void(const LabelledSector&)>;

    /// Throws std::invalid_argument if options and sensor do not fit together (checkOptions()), or
    /// if a streaming option is out of range; the message names it.
    StreamingSegmenter(SensorModel sensor, Options options, Take take,
                       const StreamingOptions& streaming = {});

    /// The tilt and the pose of the sensor (map from sensor) from now on, as far as they are known.
    /// Context is moved by the pose since it was measured, or, without one, turned by the tilt.
    /// Without both, tilt and climb of a rotating sensor are estimated from the ground
    /// (TurnMotion), if there is some; if not, context stays where it was measured. None, or
    /// numbers that are not finite: unknown.
    void setAttitude(const std::optional<Attitude>& attitude);
    void setPose(const std::optional<Eigen::Isometry3d>& map_from_sensor);
    /// The tilt of the sensor on a level vehicle: the filter takes it while the tilt is unknown.
    /// How the sensor moves is not known by it. Default: none.
    void setMount(const std::optional<Attitude>& tilt);

    /// Sectors have these: a direction was looked at once all beams have passed it. Default: none.
    /// Throws std::invalid_argument unless both are from 0 to a turn.
    void setBeamOffsets(const BeamOffsets& offsets);

    /// Adds the returns of a packet, with ranges, azimuths and rows (checkLocated()), and when it
    /// came, in seconds of any clock. Throws std::invalid_argument if one of these is unsound.
    /// `sweep` of packets that come late may be before that of others: their returns are labelled
    /// with the sector in progress. Calls the function if that ends a sector.
    void add(const Scan& returns, const Sweep& sweep, double time_s);
    /// The same for a frame of a sensor that does not turn, which is a sector. `time_s` is when its
    /// last packet arrived. `measured_s` is for how long its packets measured, if some may be lost.
    /// `first_time_s` is when its first packet arrived (none: with the last). `sensor_time_s`
    /// is when that was measured, by the sensor's clock.
    void addFrame(const Scan& returns, double time_s,
                  double measured_s = std::numeric_limits<double>::infinity(),
                  std::optional<double> first_time_s = std::nullopt,
                  std::optional<double> sensor_time_s = std::nullopt);
    /// Labels the sector in progress: no packet followed for some time.
    void flush();
    /// Forgets the context: packets that follow are of another place or sensor mode. The sector in
    /// progress is labelled before.
    void restart();

    std::size_t sectors() const { return sectors_; }
    const SensorModel& sensor() const { return filter_.sensor(); }
    const Options& options() const { return filter_.options(); }
    const StreamingOptions& streaming() const { return streaming_; }

 private:
    /// Returns, and what was found of each once they were in a sector.
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
        double time_s = 0, first_time_s = 0;    ///< the same, but for frames
        std::optional<Eigen::Isometry3d> pose;  ///< of the sensor; its rotation only: without place
        bool has_place = false;
        double measured_s = 0;  ///< without a sweep
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

    HagenFilter filter_;          ///< of all in sight at once
    SectorFilter sector_filter_;  ///< of a sector and its context
    StreamingOptions streaming_;
    Thinning thinning_;
    TurnMotion turn_motion_;  ///< told while neither tilt nor pose is known
    Take take_;
    std::optional<Attitude> attitude_, mount_;
    BeamOffsets offsets_;
    std::optional<Eigen::Isometry3d> pose_;

    std::deque<Packet> packets_;  ///< of the latest turn, in the order in which they came
    std::vector<Packet> spare_;   ///< their memory, reused
    /// Those of their returns that are context far from a sector, one packet after the other: most
    /// sectors take long stretches of it.
    Returns thinned_;
    std::size_t pending_first_ = 0, pending_end_ = 0;  ///< a stretch that is to be added
    std::size_t open_ = 0;  ///< the last ones of these: of the sector in progress
    double head_rad_ = 0;   ///< how far the sensor has turned
    double start_rad_ = 0;  ///< of the sector in progress
    std::size_t sectors_ = 0;
    Returns window_, moved_;  ///< reused; moved: of frames
    ColumnMap columns_;       ///< reused
    Scan sector_;
    std::vector<Label> labels_;         ///< of the sector's returns
    std::vector<ContextReturn> found_;  ///< of the sector's returns
    std::vector<Sweep> sweeps_;         ///< of the sector's packets
};

}  // namespace hagen::live
