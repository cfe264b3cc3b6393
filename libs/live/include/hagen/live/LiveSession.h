#pragma once
#include <hagen/live/LatencyHistogram.h>
#include <hagen/live/PacketSource.h>
#include <hagen/live/Recording.h>
#include <hagen/live/SectorDistances.h>
#include <hagen/live/SensorMotion.h>
#include <hagen/live/StreamingSegmenter.h>
#include <hagen/sensors/LidarDriver.h>
#include <hagen/settings/Settings.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace hagen::live {

/// A sensor to label while it runs.
struct LiveOptions {
    /// "VLP-16", "Puck Hi-Res", "HDL-32E", "VLP-32C", "HDL-64E" or "Mid-360".
    std::string model;
    std::filesystem::path calibration;  ///< of an HDL-64E
    Settings settings;
    StreamingOptions streaming;
    RecordingOptions recording;
    std::filesystem::path stats;  ///< JSON; empty: none
    bool overwrite = false;       ///< replaces an existing file of `stats`
    double duration_s = std::numeric_limits<double>::infinity();
    std::filesystem::path sensor_json;  ///< metadata of an Ouster; `model` is empty then
    std::filesystem::path replay;       ///< the capture that its source reads; empty: none
};

/// Figures of a session; of the packets, those of the driver. Data from the wrong address count as
/// of another sensor.
struct LiveReport : sensors::PacketCounts {
    std::size_t datagrams = 0;     ///< all but those dropped
    std::size_t dropped = 0;       ///< waited too long, or the queue was full
    std::size_t silences = 0;      ///< of 1 s
    std::size_t rate_changes = 0;  ///< of the motor
    /// How often directions of SectorDistances were in each state, every twentieth of a second.
    std::size_t times_unknown = 0, times_seen_nothing = 0, times_obstacle = 0;
    std::size_t sectors = 0, sectors_cut = 0;
    std::size_t sectors_doubtful = 0;  ///< too little of a turn was known: all near is RoI
    std::size_t returns = 0, roi = 0;
    LatencyHistogram latency;  ///< from a sector's last packet to its labels; not of those cut
    /// The nearest RoI return of the run in each direction, as SectorDistances, but for doubtful
    /// sectors; infinity: none.
    std::array<float, SectorDistances::kSectors> nearest_m{};
    std::array<SectorDistances::Sector, SectorDistances::kSectors> latest{};
    double seconds = 0;         ///< that it ran
    double filter_cpu_s = 0;    ///< CPU time of the thread that labels
    double process_cpu_s = 0;   ///< of all threads
    std::string stats_failure;  ///< why LiveOptions::stats could not be written
    Recorded recorded;          ///< if it was
};

/// The last second.
struct LiveStatus {
    double turns_per_s = 0;
    double p50_s = 0, p99_s = 0, max_s = 0;                     ///< latency; NaN: no sector
    float nearest_m = std::numeric_limits<float>::quiet_NaN();  ///< NaN: no obstacle is known
    bool is_silent = false;
};

/// Callbacks of a session, all on the thread that calls run().
struct LiveListener {
    /// Called first, with the sensor and the options of its filter.
    std::function<void(const SensorModel&, const Options&)> begin = [](const auto&, const auto&) {};
    /// The motion at a time of steadyNow_s(), called with each packet. Empty: it is not known.
    std::function<SensorMotion(double time_s)> motion;
    /// More counts for `stats`, called at the end: the name of a section, and its values.
    std::map<std::string, std::function<std::vector<std::pair<std::string, std::size_t>>()>> counts;
    /// Messages for the user: silence, another mode, another rate.
    std::function<void(const std::string& remark)> remark = [](const auto&) {};
    /// Called every half a second.
    std::function<void(const LiveReport&, const LiveStatus&)> status = [](const auto&,
                                                                          const auto&) {};
    /// Called with each labelled sector; keep it short.
    std::function<void(const LabelledSector&)> sector = [](const auto&) {};
    /// False ends the session.
    std::function<bool()> keep_going = [] { return true; };
};

/// "a VLP-16" or "the Ouster of FILE".
std::string sensorName(const LiveOptions& options);

/// Labels the packets of a source until it ends, the time is over or the listener stops it. One
/// thread receives, one labels (that of the caller; its real-time priority, if it has one, is
/// lowered by one, for good), and one records. A recording that stops early is reported, and the
/// session continues. No packet content ends it.
///
/// Throws std::runtime_error naming the file or address that failed, also a recording that cannot
/// begin, and SettingsError.
LiveReport runLive(PacketSource& source, const LiveOptions& options,
                   const LiveListener& listener = {});

}  // namespace hagen::live
