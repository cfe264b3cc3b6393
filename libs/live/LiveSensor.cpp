#include "LiveSensor.h"

#include <hagen/captures/LivoxScans.h>
#include <hagen/captures/OusterScan.h>
#include <hagen/captures/VelodyneTurns.h>
#include <hagen/observations/VelodyneCalibrationFile.h>
#include <hagen/streaming/LivoxStream.h>
#include <hagen/streaming/OusterStream.h>
#include <hagen/streaming/VelodyneStream.h>

#include <algorithm>
#include <optional>

namespace hagen::live {
namespace {

constexpr std::size_t kPositionBytes = 512;

/// What all have in common: a stream that labels.
template <class Stream>
class StreamSensor : public LiveSensor {
 public:
    const streaming::StreamingSegmenter& segmenter() const override { return stream_->segmenter(); }
    void move(const streaming::SensorMotion& motion) override {
        stream_->setAttitude(motion.attitude);
        stream_->setPose(motion.map_from_sensor);
    }
    void flush() override { stream_->flush(); }

 protected:
    Counts commonCounts() const {
        const auto& of_stream = stream_->counts();
        Counts counts;
        counts.packets = of_stream.packets;
        counts.lost = of_stream.lost;
        counts.late = of_stream.late;
        counts.repeated = of_stream.repeated;
        counts.interruptions = of_stream.interruptions;
        return counts;
    }
    template <class Turns>
    void record(Turns& turns) {
        complete_.insert(complete_.end(), turns.complete().begin(), turns.complete().end());
        turns.complete().clear();
    }
    std::unique_ptr<Stream> stream_;
};

class VelodyneSensor : public StreamSensor<streaming::VelodyneStream> {
 public:
    VelodyneSensor(const LiveOptions& options, const streaming::StreamingSegmenter::Take& take)
        : model_(options.model == kHdl64 ? observations::hdl64Model()
                                         : observations::velodyneModel(options.model)) {
        std::shared_ptr<const mrpt::obs::VelodyneCalibration> calibration;
        if (!options.calibration.empty()) {
            calibration = std::make_shared<const mrpt::obs::VelodyneCalibration>(
                observations::readVelodyneCalibration(options.calibration));
        }
        stream_ = std::make_unique<streaming::VelodyneStream>(model_, options.settings, take,
                                                              options.streaming, calibration);
        if (!options.recording.file.empty()) turns_.emplace(model_, "velodyne", calibration);
    }

    Counts counts() const override {
        Counts counts = commonCounts();
        const auto& of_stream = stream_->counts();
        counts.wrong_size = of_stream.wrong_size;
        counts.position = position_;
        counts.foreign = of_stream.other_model;
        counts.unsound = of_stream.unsound;
        counts.mode_changes = of_stream.mode_changes;
        counts.scans = of_stream.turns;
        return counts;
    }
    bool isDual() const override { return stream_->isDual(); }

    bool isToldByAddress(const Packet& packet) const override {
        const std::uint8_t* const bytes = packet.bytes.data();
        if (!captures::isVelodyneData(bytes, packet.bytes.size())) return false;
        const bool is_hdl64 = &model_ == &observations::hdl64Model();
        if (captures::isOfHdl64(bytes)) return is_hdl64;
        return !is_hdl64 && model_.id == bytes[captures::kVelodyneModelAt];
    }

    bool add(const Packet& packet) override {
        if (packet.bytes.size() == kPositionBytes) {
            ++position_;
            return false;
        }
        const auto taken = stream_->add(packet.bytes.data(), packet.bytes.size(), packet.arrival_s);
        if (turns_ && isToldByAddress(packet)) {
            captures::VelodynePacket raw;
            std::copy(packet.bytes.begin(), packet.bytes.end(),
                      reinterpret_cast<std::uint8_t*>(&raw.raw));
            raw.time_ns = packet.time_ns;
            turns_->add(raw);
            record(*turns_);
        }
        return taken == streaming::VelodyneStream::Taken::Yes;
    }
    void finish() override {
        if (!turns_) return;
        turns_->finish();
        record(*turns_);
    }

 private:
    const observations::VelodyneModel& model_;
    std::optional<captures::VelodyneTurns> turns_;
    std::size_t position_ = 0;
};

class OusterSensor : public StreamSensor<streaming::OusterStream> {
 public:
    OusterSensor(const LiveOptions& options, const streaming::StreamingSegmenter::Take& take)
        : is_recorded_(!options.recording.file.empty()) {
        stream_ = std::make_unique<streaming::OusterStream>(
            captures::readOusterSensor(options.sensor_json), options.settings, take,
            options.streaming);
    }

    Counts counts() const override {
        Counts counts = commonCounts();
        const auto& of_stream = stream_->counts();
        counts.wrong_size = of_stream.wrong_size;
        counts.position = of_stream.imu;
        counts.foreign = of_stream.other_sensor;
        counts.unsound = of_stream.unsound;
        counts.scans = of_stream.turns;
        return counts;
    }

    bool isToldByAddress(const Packet& packet) const override {
        const captures::OusterSensor& sensor = stream_->sensor();
        const bool has_serial = !sensor.profile.is_legacy && !sensor.serial.empty();
        return !has_serial && packet.bytes.size() == sensor.packetBytes() &&
               captures::isOfLidar(packet.bytes.data(), sensor);
    }

    bool add(const Packet& packet) override {
        const auto taken = stream_->add(packet.bytes.data(), packet.bytes.size(), packet.arrival_s,
                                        packet.time_ns);
        recordFrames();
        return taken == streaming::OusterStream::Taken::Yes;
    }
    void finish() override {
        stream_->finish();
        recordFrames();
    }

 private:
    void recordFrames() {
        for (const captures::OusterFrame& frame : stream_->complete()) {
            if (is_recorded_) {
                complete_.push_back(captures::observationOf(frame, stream_->sensor()));
            }
        }
        stream_->complete().clear();
    }
    const bool is_recorded_;
};

class LivoxSensor : public StreamSensor<streaming::LivoxStream> {
 public:
    LivoxSensor(const LiveOptions& options, const streaming::StreamingSegmenter::Take& take) {
        stream_ = std::make_unique<streaming::LivoxStream>(options.settings, take);
        if (!options.recording.file.empty()) scans_.emplace("livox");
    }

    bool turns() const override { return false; }
    Counts counts() const override {
        Counts counts = commonCounts();
        counts.wrong_size = stream_->counts().foreign;
        counts.position = stream_->counts().imu;
        counts.scans = segmenter().sectors() / 5;  // frames of 20 ms
        return counts;
    }

    bool isToldByAddress(const Packet& packet) const override {
        return livoxPacketOf(datagramOf(packet)).has_value();
    }

    bool add(const Packet& packet) override {
        const auto taken = stream_->add(packet.bytes.data(), packet.bytes.size(), packet.arrival_s);
        const auto data = livoxPacketOf(datagramOf(packet));
        if (scans_ && data) {
            scans_->add(*data, packet.time_ns);
            record(*scans_);
        }
        return taken == streaming::LivoxStream::Taken::Yes;
    }
    void finish() override {
        if (!scans_) return;
        scans_->finish();
        record(*scans_);
    }

 private:
    static captures::Datagram datagramOf(const Packet& packet) {
        captures::Datagram datagram;
        datagram.bytes = packet.bytes.data();
        datagram.size = packet.bytes.size();
        return datagram;
    }
    std::optional<captures::LivoxScans> scans_;
};

}  // namespace

std::unique_ptr<LiveSensor> makeLiveSensor(const LiveOptions& options,
                                           const streaming::StreamingSegmenter::Take& take) {
    if (!options.sensor_json.empty()) return std::make_unique<OusterSensor>(options, take);
    if (options.model == kLivox) return std::make_unique<LivoxSensor>(options, take);
    return std::make_unique<VelodyneSensor>(options, take);
}

}  // namespace hagen::live
