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
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hagen::live {

struct LiveOptions {
    /// The sensor model: "VLP-16", "Puck Hi-Res", "HDL-32E", "VLP-32C", "HDL-64E" or "Mid-360".
    std::string model;
    std::filesystem::path calibration;  ///< only for an HDL-64E
    Settings settings;
    StreamingOptions streaming;
    RecordingOptions recording;
    std::filesystem::path stats;  ///< JSON file, or empty
    bool overwrite = false;       ///< replaces an existing `stats` file
    double duration_s = std::numeric_limits<double>::infinity();
    std::filesystem::path sensor_json;  ///< Ouster metadata; requires an empty `model`
    std::filesystem::path replay;       ///< the capture being replayed, or empty
    std::optional<sensors::IpAddress>
        from_ip;  ///< the sensor's; by default, that of the first packet
};

/// Session statistics; packet counts come from the driver. Data packets from other addresses are
/// counted as packets of other sensors.
struct LiveReport : sensors::PacketCounts {
    std::size_t datagrams = 0;     ///< datagrams without the dropped ones
    std::size_t dropped = 0;       ///< datagrams that waited too long or found the queue full
    std::size_t silences = 0;      ///< silences of at least 1 s
    std::size_t rate_changes = 0;  ///< changes of the motor speed
    /// Counts of the states of SectorDistances directions, sampled at 20 Hz.
    std::size_t times_unknown = 0, times_seen_nothing = 0, times_obstacle = 0;
    std::size_t sectors = 0, sectors_cut = 0;
    std::size_t sectors_doubtful = 0;  ///< too little context, so all near returns are RoI
    std::size_t returns = 0, roi = 0;
    LatencyHistogram latency;  ///< from a sector's last packet to its labels; without cut sectors
    /// Distance to the nearest RoI return of the run in each direction, as in SectorDistances,
    /// without doubtful sectors; infinity if there was none.
    std::array<float, SectorDistances::kSectors> nearest_m{};
    std::array<SectorDistances::Sector, SectorDistances::kSectors> latest{};
    double seconds = 0;         ///< duration
    double filter_cpu_s = 0;    ///< CPU time of the labelling thread
    double process_cpu_s = 0;   ///< CPU time of all threads
    std::string stats_failure;  ///< why LiveOptions::stats could not be written
    Recorded recorded;          ///< empty if nothing was recorded
};

/// Statistics since the last status.
struct LiveStatus {
    double turns_per_s = 0;
    double p50_s = 0, p99_s = 0, max_s = 0;                     ///< latency; NaN without sectors
    float nearest_m = std::numeric_limits<float>::quiet_NaN();  ///< NaN if no obstacle is known
    double nearest_deg = 0;  ///< its direction, clockwise from ahead
    bool is_silent = false;
};

/// Callbacks of a session, all on the thread that calls run().
struct LiveListener {
    /// Called first, with the sensor and the filter options.
    std::function<void(const SensorModel&, const Options&)> begin = [](const auto&, const auto&) {};
    /// Returns the motion at a steadyNow_s() time; called for each packet. Empty if unknown.
    std::function<SensorMotion(double time_s)> motion;
    /// Functions that return more counts for `stats`, by section name; called at the end.
    std::map<std::string, std::function<std::vector<std::pair<std::string, std::size_t>>()>> counts;
    /// Called with messages for the user, such as silence, a changed mode or a changed rate.
    std::function<void(const std::string& remark)> remark = [](const auto&) {};
    /// Called every 0.5 s.
    std::function<void(const LiveReport&, const LiveStatus&)> status = [](const auto&,
                                                                          const auto&) {};
    /// Called with each labelled sector; must return quickly.
    std::function<void(const LabelledSector&)> sector = [](const auto&) {};
    /// Returns false to end the session.
    std::function<bool()> keep_going = [] { return true; };
};

/// The sensor's name in messages: "a VLP-16 at 10.0.0.101" or "the Ouster of FILE".
std::string sensorName(const LiveOptions& options);

/// Labels the packets of a source until the source ends, the duration is over or the listener ends
/// the session. One thread receives, the caller labels (its real-time priority, if any, is
/// permanently lowered by one), and one thread records. If recording fails, the failure is reported
/// and the session continues. No packet content ends the session.
///
/// Throws std::runtime_error naming the file or address that failed, even if only recording cannot
/// start, and SettingsError.
LiveReport runLive(PacketSource& source, const LiveOptions& options,
                   const LiveListener& listener = {});

}  // namespace hagen::live
