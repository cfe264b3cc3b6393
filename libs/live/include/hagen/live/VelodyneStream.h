#pragma once
#include <hagen/live/RecentPackets.h>
#include <hagen/live/StreamingSegmenter.h>
#include <hagen/sensors/VelodyneCalibration.h>
#include <hagen/sensors/VelodyneDecoder.h>
#include <hagen/sensors/VelodyneModel.h>
#include <hagen/sensors/VelodynePacket.h>
#include <hagen/settings/Settings.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace hagen::live {

/// Labels the packets of one Velodyne sector by sector, as they come.
///
/// Packets that come up to sixteen late are labelled with the sector in progress. Later ones are
/// left out: what they saw is not what is there now. Sixteen of these in a row are of a clock that
/// was set, and are taken then, but for copies of packets of the last 0.3 s. Nothing throws because
/// of what a packet holds: each is taken, or refused and counted.
class VelodyneStream {
 public:
    /// What became of a datagram.
    enum class Taken { Yes, WrongSize, OtherModel, Repeated, Unsound, Late };

    struct Counts {
        std::size_t packets = 0;         ///< taken
        std::size_t wrong_size = 0;      ///< datagrams that are no data packets
        std::size_t other_model = 0;     ///< data packets of another model
        std::size_t repeated = 0;        ///< came again, left out
        std::size_t unsound = 0;         ///< without a sound block, left out
        std::size_t unsound_blocks = 0;  ///< of packets that were taken
        std::size_t late = 0;            ///< came after a later one
        std::size_t too_late = 0;        ///< of these: by more than sixteen packets, left out
        std::size_t lost = 0;  ///< missing by the sensor's clock; late ones are found again
        std::size_t interruptions = 0;   ///< gaps of more than 50 ms, and jumps of the clock
        std::size_t mode_changes = 0;    ///< between one return and two per firing
        std::size_t turns = 0;           ///< begun after the first one
        std::size_t returns_masked = 0;  ///< of the airframe
    };

    /// `settings`: options, range limits, airframe and mount. `calibration` is of an HDL-64E; null:
    /// that of the model. Throws SettingsError if the options do not fit the sensor, and
    /// std::invalid_argument for an HDL-64E without calibration.
    VelodyneStream(const sensors::VelodyneModel& model, const Settings& settings,
                   StreamingSegmenter::Take take, const StreamingOptions& streaming = {},
                   const sensors::VelodyneCalibration* calibration = nullptr);

    /// Takes a datagram that came at `arrival_s`, in seconds of any clock that does not go back.
    /// Throws std::invalid_argument if that is not finite.
    Taken add(const std::uint8_t* bytes, std::size_t size, double arrival_s);
    /// Labels what has come: the sensor is silent.
    void flush() { segmenter_->flush(); }

    /// The tilt and the pose of the sensor from now on; none: not known (StreamingSegmenter). The
    /// filter then takes the tilt of the settings' mount on a level vehicle.
    void setAttitude(const std::optional<Attitude>& attitude);
    void setPose(const std::optional<Eigen::Isometry3d>& map_from_sensor);

    /// Whether the latest packet has two returns per firing.
    bool isDual() const { return is_dual_; }
    const Counts& counts() const { return counts_; }
    const StreamingSegmenter& segmenter() const { return *segmenter_; }

 private:
    /// Sound firings of a packet that follow each other.
    struct Run {
        int first, end;
    };

    struct Held {
        sensors::VelodynePacket packet;
        double arrival_s;
    };

    Taken hold(const sensors::VelodynePacket& packet, double arrival_s);
    Taken take(const sensors::VelodynePacket& packet, double arrival_s);
    void findRuns(const sensors::VelodynePacket& packet);
    bool readSweep(const sensors::VelodynePacket& packet, double elapsed_us, Sweep& sweep);
    void addRuns(const sensors::VelodynePacket& packet, const Sweep& sweep, double arrival_s);

    const sensors::VelodyneModel& model_;
    Settings settings_;
    std::unique_ptr<StreamingSegmenter> segmenter_;
    sensors::VelodyneCalibration calibration_;
    sensors::DecoderWorkspace decoder_;
    Scan returns_, part_;
    std::vector<Run> runs_;  ///< of the latest packet
    RecentPackets recent_;
    std::vector<Held> held_;  ///< too late, in a row
    bool has_last_ = false, is_dual_ = false;
    double last_us_ = 0;  ///< by the sensor's clock, of the latest packet
    Sweep last_sweep_{};  ///< likewise
    Counts counts_;
};

}  // namespace hagen::live
