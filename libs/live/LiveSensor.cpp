#include "live/LiveSensor.h"

#include <hagen/live/LivoxStream.h>
#include <hagen/live/OusterStream.h>
#include <hagen/live/VelodyneStream.h>
#include <hagen/sensors/VelodyneCalibrationFile.h>

#include <cstdint>
#include <optional>
#include <string>

namespace hagen::live {
namespace {

constexpr std::size_t kPositionBytes = 512;

/// What all have in common: a stream that labels.
template <class Stream>
class StreamSensor : public LiveSensor {
 public:
    const live::StreamingSegmenter& segmenter() const override { return stream_->segmenter(); }
    void move(const live::SensorMotion& motion) override {
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
    std::unique_ptr<Stream> stream_;
};

class VelodyneSensor : public StreamSensor<live::VelodyneStream> {
 public:
    VelodyneSensor(const LiveOptions& options, const live::StreamingSegmenter::Take& take)
        : model_(options.model == kHdl64 ? sensors::hdl64Model()
                                         : sensors::velodyneModel(options.model)) {
        std::optional<sensors::VelodyneCalibration> calibration;
        if (!options.calibration.empty()) {
            calibration = sensors::readVelodyneCalibration(options.calibration);
        }
        stream_ = std::make_unique<live::VelodyneStream>(model_, options.settings, take,
                                                         options.streaming,
                                                         calibration ? &*calibration : nullptr);
    }

    Counts counts() const override {
        Counts counts = commonCounts();
        const auto& of_stream = stream_->counts();
        counts.wrong_size = of_stream.wrong_size;
        counts.position = position_;
        counts.foreign = of_stream.other_model;
        counts.unsound = of_stream.unsound;
        counts.unsound_blocks = of_stream.unsound_blocks;
        counts.too_late = of_stream.too_late;
        counts.mode_changes = of_stream.mode_changes;
        counts.scans = of_stream.turns;
        return counts;
    }
    bool isDual() const override { return stream_->isDual(); }

    bool isData(const Packet& packet) const override {
        const std::uint8_t* const bytes = packet.bytes.data();
        if (!sensors::isVelodyneData(bytes, packet.bytes.size())) return false;
        const bool is_hdl64 = &model_ == &sensors::hdl64Model();
        if (sensors::isOfHdl64(bytes)) return is_hdl64;
        return !is_hdl64 && model_.id == bytes[sensors::kVelodyneModelAt];
    }
    bool isToldByAddress(const Packet& packet) const override { return isData(packet); }

    bool add(const Packet& packet) override {
        if (packet.bytes.size() == kPositionBytes) {
            ++position_;
            return false;
        }
        const auto taken = stream_->add(packet.bytes.data(), packet.bytes.size(), packet.arrival_s);
        return taken == live::VelodyneStream::Taken::Yes;
    }

 private:
    const sensors::VelodyneModel& model_;
    std::size_t position_ = 0;
};

class OusterSensor : public StreamSensor<live::OusterStream> {
 public:
    OusterSensor(const LiveOptions& options, const live::StreamingSegmenter::Take& take) {
        stream_ =
            std::make_unique<live::OusterStream>(sensors::readOusterSensor(options.sensor_json),
                                                 options.settings, take, options.streaming);
    }

    Counts counts() const override {
        Counts counts = commonCounts();
        const auto& of_stream = stream_->counts();
        counts.wrong_size = of_stream.wrong_size;
        counts.position = of_stream.imu;
        counts.foreign = of_stream.other_sensor;
        counts.uncertain = of_stream.uncertain;
        counts.restarts = of_stream.restarts;
        counts.unsound = of_stream.unsound;
        counts.too_late = of_stream.too_late;
        counts.scans = of_stream.turns;
        return counts;
    }

    bool isData(const Packet& packet) const override {
        const sensors::OusterSensor& sensor = stream_->sensor();
        const std::uint8_t* const bytes = packet.bytes.data();
        if (packet.bytes.size() != sensor.packetBytes() || !isOfLidar(bytes, sensor)) return false;
        return !hasSerial() || std::to_string(serialOf(bytes, sensor)) == sensor.serial;
    }
    bool isToldByAddress(const Packet& packet) const override {
        return !hasSerial() && isData(packet);
    }

    bool add(const Packet& packet) override {
        const auto taken = stream_->add(packet.bytes.data(), packet.bytes.size(), packet.arrival_s,
                                        packet.time_ns);
        stream_->complete().clear();  // the recorder puts its own turns together
        return taken == live::OusterStream::Taken::Yes;
    }
    void finish() override { stream_->finish(); }

 private:
    bool hasSerial() const {
        return !stream_->sensor().profile.is_legacy && !stream_->sensor().serial.empty();
    }
};

class LivoxSensor : public StreamSensor<live::LivoxStream> {
 public:
    LivoxSensor(const LiveOptions& options, const live::StreamingSegmenter::Take& take) {
        stream_ = std::make_unique<live::LivoxStream>(options.settings, take);
    }

    bool turns() const override { return false; }
    Counts counts() const override {
        Counts counts = commonCounts();
        counts.late += stream_->counts().too_late;
        counts.too_late = stream_->counts().too_late;
        counts.wrong_size = stream_->counts().foreign;
        counts.position = stream_->counts().imu;
        counts.scans = segmenter().sectors() / 5;  // frames of 20 ms
        return counts;
    }

    bool isData(const Packet& packet) const override {
        sensors::Datagram datagram;
        datagram.bytes = packet.bytes.data();
        datagram.size = packet.bytes.size();
        return livoxPacketOf(datagram).has_value();
    }
    bool isToldByAddress(const Packet& packet) const override { return isData(packet); }

    bool add(const Packet& packet) override {
        const auto taken = stream_->add(packet.bytes.data(), packet.bytes.size(), packet.arrival_s);
        return taken == live::LivoxStream::Taken::Yes;
    }
};

}  // namespace

std::unique_ptr<LiveSensor> makeLiveSensor(const LiveOptions& options,
                                           const live::StreamingSegmenter::Take& take) {
    if (!options.sensor_json.empty()) return std::make_unique<OusterSensor>(options, take);
    if (options.model == kLivox) return std::make_unique<LivoxSensor>(options, take);
    return std::make_unique<VelodyneSensor>(options, take);
}

}  // namespace hagen::live
