#pragma once
#include <hagen/live/RecentPackets.h>
#include <hagen/live/StreamingSegmenter.h>
#include <hagen/sensors/LivoxPacket.h>
#include <hagen/settings/Settings.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace hagen::live {

/// Labels the packets of a Livox Mid-360 frame by frame: each is 20 ms, judged together with the
/// returns of the 80 ms before.
class LivoxStream {
 public:
    struct Counts {
        std::size_t packets = 0;   ///< taken
        std::size_t imu = 0;       ///< packets of the IMU, left out
        std::size_t foreign = 0;   ///< datagrams of something else
        std::size_t repeated = 0;  ///< came again, left out
        std::size_t late = 0;      ///< came after a later one; they join the frame in progress
        std::size_t too_late = 0;  ///< by more than sixteen packets; left out
        std::size_t lost = 0;      ///< missing by their numbers
        /// Jumps of the sensor's clock: ahead by more than a second, or back by more than sixteen
        /// packets, four packets in a row.
        std::size_t interruptions = 0;
        std::size_t returns_masked = 0;  ///< of the airframe
    };
    enum class Taken { Yes, Foreign, Repeated, TooLate, Imu };

    /// Throws SettingsError if the options do not fit the sensor.
    LivoxStream(const Settings& settings, StreamingSegmenter::Take take, double frame_s = 0.02,
                double window_s = 0.1);

    /// Takes a datagram that came at `arrival_s`, in seconds of any clock that does not go back.
    /// Throws std::invalid_argument if that is not finite.
    Taken add(const std::uint8_t* bytes, std::size_t size, double arrival_s);
    /// Labels what has come: the sensor is silent.
    void flush();

    /// As of StreamingSegmenter.
    void setAttitude(const std::optional<Attitude>& attitude);
    void setPose(const std::optional<Eigen::Isometry3d>& map_from_sensor);

    const Counts& counts() const { return counts_; }
    const StreamingSegmenter& segmenter() const { return *segmenter_; }

 private:
    bool wentBack(std::uint64_t time_ns);

    Settings settings_;
    double frame_s_;
    std::unique_ptr<StreamingSegmenter> segmenter_;
    bool is_begun_ = false, has_last_ = false;
    std::uint64_t start_ns_ = 0, last_ns_ = 0;
    std::uint64_t too_late_ns_ = 0;      ///< the time of the latest packet that was too late
    std::size_t too_late_in_a_row_ = 0;  ///< up to now
    std::uint16_t last_number_ = 0;
    RecentPackets recent_;
    std::size_t packets_of_frame_ = 0;
    double first_arrival_s_ = 0, last_arrival_s_ = 0;  ///< of the frame
    double measured_s_ = 0;                            ///< by the packets of the frame
    Scan frame_;
    std::vector<std::uint8_t> tags_;
    Counts counts_;
};

}  // namespace hagen::live
