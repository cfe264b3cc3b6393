#include <hagen/captures/LivoxScans.h>
#include <hagen/captures/OusterObservation.h>
#include <hagen/captures/VelodyneTurns.h>
#include <hagen/live/LiveSession.h>
#include <hagen/packets/LivoxPacket.h>
#include <hagen/packets/OusterFrames.h>
#include <hagen/packets/VelodyneCalibrationFile.h>
#include <hagen/recording/SensorTurns.h>

#include <algorithm>

namespace hagen::recording {
namespace {

class OfVelodyne : public SensorTurns {
 public:
    OfVelodyne(const packets::VelodyneModel& model, const packets::VelodyneCalibration* calibration)
        : turns_(model, "velodyne", calibration) {}

    void add(const live::Packet& packet) override {
        packets::VelodynePacket raw;
        if (packet.bytes.size() != raw.bytes.size()) return;
        std::copy(packet.bytes.begin(), packet.bytes.end(), raw.bytes.begin());
        raw.time_ns = packet.time_ns;
        turns_.add(raw);
        take();
    }
    void finish() override {
        turns_.finish();
        take();
    }

 private:
    void take() {
        complete_.insert(complete_.end(), turns_.complete().begin(), turns_.complete().end());
        turns_.complete().clear();
    }
    captures::VelodyneTurns turns_;
};

class OfOuster : public SensorTurns {
 public:
    explicit OfOuster(const packets::OusterSensor& sensor) : sensor_(sensor), frames_(sensor_) {}

    void add(const live::Packet& packet) override {
        if (packet.bytes.size() != sensor_.packetBytes()) return;
        frames_.add(packet.bytes.data(), packet.time_ns);
        take();
    }
    void finish() override {
        frames_.finish();
        take();
    }

 private:
    void take() {
        for (const packets::OusterFrame& frame : frames_.complete()) {
            complete_.push_back(captures::observationOf(frame, sensor_));
        }
        frames_.complete().clear();
    }
    const packets::OusterSensor sensor_;
    packets::OusterFrames frames_;
};

class OfLivox : public SensorTurns {
 public:
    void add(const live::Packet& packet) override {
        packets::Datagram datagram;
        datagram.bytes = packet.bytes.data();
        datagram.size = packet.bytes.size();
        if (const auto data = livoxPacketOf(datagram)) scans_.add(*data, packet.time_ns);
        take();
    }
    void finish() override {
        scans_.finish();
        take();
    }

 private:
    void take() {
        complete_.insert(complete_.end(), scans_.complete().begin(), scans_.complete().end());
        scans_.complete().clear();
    }
    captures::LivoxScans scans_{"livox"};
};

}  // namespace

std::unique_ptr<SensorTurns> makeSensorTurns(const std::string& model,
                                             const std::filesystem::path& sensor_json,
                                             const std::filesystem::path& calibration) {
    if (!sensor_json.empty()) {
        return std::make_unique<OfOuster>(packets::readOusterSensor(sensor_json));
    }
    if (model == live::kLivox) return std::make_unique<OfLivox>();
    if (model != live::kHdl64) {
        return std::make_unique<OfVelodyne>(packets::velodyneModel(model), nullptr);
    }
    const packets::VelodyneCalibration of_sensor = packets::readVelodyneCalibration(calibration);
    return std::make_unique<OfVelodyne>(packets::hdl64Model(), &of_sensor);
}

}  // namespace hagen::recording
