#pragma once
#include <hagen/captures/VelodyneTurns.h>
#include <hagen/live/LiveSession.h>
#include <hagen/live/PacketSource.h>
#include <hagen/live/TurnRecorder.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace hagen::live {

constexpr double kSilence_s = 1.0;  ///< without packets; is told
constexpr const char* kLivox = "Mid-360";
constexpr const char* kHdl64 = "HDL-64E";

/// "a VLP-16".
std::string nameOf(const LiveOptions& options);

/// One sensor of any kind: its packets become labelled sectors and recorded turns.
class LiveSensor {
 public:
    /// Tells the listener when the sensor has another address. Both must outlive it.
    LiveSensor(const LiveOptions& options, const LiveListener& listener,
               const streaming::StreamingSegmenter::Take& take);

    const streaming::StreamingSegmenter& segmenter() const;
    /// Records from now on, if the options say so. A live sensor is never kept waiting.
    void startRecording(bool is_live);

    /// Tells the stream how the sensor moves.
    void move(const streaming::SensorMotion& motion);
    /// Whether the packet is one of the sensor, and was taken.
    bool take(const Packet& packet);
    /// Labels the sector in progress, if there is one: no packet waits.
    void flush();
    /// No packet comes any more.
    void end();
    /// What was recorded, after the end.
    TurnRecorder::Counts finishRecording();

    /// When the last packet was taken; 0: none.
    double lastPacket_s() const { return last_packet_s_; }
    bool isFlushed() const { return is_flushed_; }
    bool hasTurns() const { return livox_ == nullptr; }
    /// Changes between one return and two per firing, and whether it is two now.
    std::size_t modeChanges() const { return velodyne_ ? velodyne_->counts().mode_changes : 0; }
    bool isDual() const { return velodyne_ && velodyne_->isDual(); }
    /// Why the recording has ended; empty: it has not.
    std::string recordingFailure() const { return recorder_ ? recorder_->failure() : ""; }
    /// Writes how many packets of each kind came.
    void count(LiveReport& report) const;

 private:
    bool isOfSensor(const Packet& packet);
    bool takeVelodyne(const Packet& packet);
    bool takeLivox(const Packet& packet);
    bool takeOuster(const Packet& packet);
    void recordVelodyne();
    void recordOuster();

    const LiveOptions& options_;
    const LiveListener& listener_;
    std::shared_ptr<const mrpt::obs::VelodyneCalibration> calibration_;
    std::unique_ptr<streaming::VelodyneStream> velodyne_;
    std::unique_ptr<streaming::LivoxStream> livox_;
    std::unique_ptr<streaming::OusterStream> ouster_;
    std::optional<captures::VelodyneTurns> turns_;
    std::unique_ptr<TurnRecorder> recorder_;

    double last_packet_s_ = 0;
    bool is_flushed_ = true;
    std::optional<std::uint32_t> sensor_ip_;
    std::size_t position_ = 0, foreign_ip_ = 0;
};

}  // namespace hagen::live
