#pragma once
#include <hagen/live/StreamingSegmenter.h>
#include <hagen/sensors/OusterFrames.h>
#include <hagen/sensors/OusterSensor.h>
#include <hagen/settings/Settings.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

namespace hagen::live {

/// Labels the packets of one Ouster sector by sector, as they come. Poses and tilts are those of
/// the origin of its beams (its lidar frame, with the axes of the sensor).
///
/// Packets that come up to sixteen late are labelled with the sector in progress.
class OusterStream {
 public:
    enum class Taken { Yes, WrongSize, OtherSensor, Imu, Repeated, Late, Unsound, Uncertain };

    struct Counts {
        std::size_t packets = 0;        ///< taken
        std::size_t wrong_size = 0;     ///< datagrams that are no packets of this profile
        std::size_t other_sensor = 0;   ///< with another serial number
        std::size_t imu = 0;            ///< packets of the IMU, left out
        std::size_t repeated = 0;       ///< came again, left out
        std::size_t unsound = 0;        ///< without a valid column, left out
        std::size_t late = 0;           ///< came after a later one
        std::size_t too_late = 0;       ///< of these: by more than sixteen packets; no label
        std::size_t lost = 0;           ///< missing in turns that are complete, but for the first
        std::size_t interruptions = 0;  ///< jumps by more than two turns
        /// Left out, since it is not certain that turns have the columns of the metadata.
        std::size_t uncertain = 0;
        std::size_t restarts = 0;        ///< of the sensor, by its packets
        std::size_t turns = 0;           ///< complete ones
        std::size_t returns_masked = 0;  ///< of the airframe
    };

    /// Throws SettingsError if the options do not fit the sensor.
    OusterStream(const sensors::OusterSensor& sensor, const Settings& settings,
                 StreamingSegmenter::Take take, const StreamingOptions& streaming = {});
    OusterStream(const OusterStream&) = delete;
    OusterStream& operator=(const OusterStream&) = delete;

    /// Takes a datagram that came at `arrival_s`, in seconds of any clock that does not go back,
    /// and at `time_ns` since 1970. Throws std::invalid_argument if `arrival_s` is not finite.
    Taken add(const std::uint8_t* bytes, std::size_t size, double arrival_s, std::int64_t time_ns);
    /// Labels what has come: the sensor is silent.
    void flush() { segmenter_->flush(); }
    /// Completes the turns in progress.
    void finish() { frames_.finish(); }

    /// As of VelodyneStream.
    void setAttitude(const std::optional<Attitude>& attitude);
    void setPose(const std::optional<Eigen::Isometry3d>& map_from_sensor);

    /// The turns that are complete, oldest first. The caller takes them out.
    std::deque<sensors::OusterFrame>& complete() { return frames_.complete(); }
    const sensors::OusterSensor& sensor() const { return sensor_; }
    const Counts& counts() const { return counts_; }
    const StreamingSegmenter& segmenter() const { return *segmenter_; }

 private:
    void countLosses();
    void addRuns(const sensors::OusterFrame& frame, long long turn, double arrival_s);

    const sensors::OusterSensor sensor_;
    Settings settings_;
    sensors::OusterFrames frames_;
    std::unique_ptr<StreamingSegmenter> segmenter_;
    double ahead_rad_ = 0;  ///< clockwise from the sensor's x axis to column 0
    bool has_last_ = false, is_uncertain_ = false;
    std::uint16_t last_id_ = 0;  ///< of the latest packet
    long long turn_ = 0;         ///< likewise, counted on
    long long last_at_ = 0;      ///< its first column, counted on
    std::size_t missing_of_first_ = 0;
    std::vector<std::size_t> columns_, run_;
    Scan returns_;
    Counts counts_;
};

}  // namespace hagen::live
