#include "LiveSensor.h"

#include <hagen/captures/OusterScan.h>
#include <hagen/observations/VelodyneCalibrationFile.h>

#include <algorithm>
#include <utility>

namespace hagen::live {
namespace {

using Taken = streaming::VelodyneStream::Taken;

constexpr std::size_t kPositionBytes = 512;

const observations::VelodyneModel& velodyneOf(const std::string& name) {
    return name == kHdl64 ? observations::hdl64Model() : observations::velodyneModel(name);
}

}  // namespace

std::string nameOf(const LiveOptions& options) {
    if (options.sensor_json.empty()) return "a " + options.model;
    return "the Ouster of " + options.sensor_json.string();
}

LiveSensor::LiveSensor(const LiveOptions& options, const LiveListener& listener,
                       const streaming::StreamingSegmenter::Take& take)
    : options_(options), listener_(listener) {
    if (!options.sensor_json.empty()) {
        ouster_ = std::make_unique<streaming::OusterStream>(
            captures::readOusterSensor(options.sensor_json), options.settings, take,
            options.streaming);
        return;
    }
    if (options.model == kLivox) {
        livox_ = std::make_unique<streaming::LivoxStream>(options.settings, take);
        return;
    }
    if (!options.calibration.empty()) {
        calibration_ = std::make_shared<const mrpt::obs::VelodyneCalibration>(
            observations::readVelodyneCalibration(options.calibration));
    }
    velodyne_ = std::make_unique<streaming::VelodyneStream>(
        velodyneOf(options.model), options.settings, take, options.streaming, calibration_);
}

const streaming::StreamingSegmenter& LiveSensor::segmenter() const {
    if (ouster_) return ouster_->segmenter();
    return velodyne_ ? velodyne_->segmenter() : livox_->segmenter();
}

void LiveSensor::startRecording(bool is_live) {
    if (options_.recording.file.empty() || livox_) return;
    TurnRecorder::Options recording = options_.recording;
    recording.waits = !is_live;
    if (velodyne_) turns_.emplace(velodyneOf(options_.model), "velodyne", calibration_);
    recorder_ = std::make_unique<TurnRecorder>(recording, options_.settings);
}

void LiveSensor::move(const streaming::SensorMotion& motion) {
    const auto tell = [&](auto& stream) {
        stream.setAttitude(motion.attitude);
        stream.setPose(motion.map_from_sensor);
    };
    if (velodyne_) tell(*velodyne_);
    if (livox_) tell(*livox_);
    if (ouster_) tell(*ouster_);
}

bool LiveSensor::take(const Packet& packet) {
    const bool is_taken = velodyne_ ? takeVelodyne(packet)
                          : ouster_ ? takeOuster(packet)
                                    : takeLivox(packet);
    if (is_taken) {
        last_packet_s_ = packet.arrival_s;
        is_flushed_ = false;
    }
    return is_taken;
}

void LiveSensor::flush() {
    if (velodyne_) velodyne_->flush();
    if (livox_) livox_->flush();
    if (ouster_) ouster_->flush();
    is_flushed_ = true;
}

void LiveSensor::end() {
    flush();
    if (ouster_) ouster_->finish();
}

TurnRecorder::Counts LiveSensor::finishRecording() {
    if (!recorder_) return {};
    if (ouster_) {
        recordOuster();
    } else {
        turns_->finish();
        recordVelodyne();
    }
    return recorder_->finish();
}

/// Packets of the same model from another address are foreign, unless the first one fell silent:
/// a sensor may come back with another address.
bool LiveSensor::isOfSensor(const Packet& packet) {
    if (!sensor_ip_) {
        sensor_ip_ = packet.from_ip;
    } else if (*sensor_ip_ != packet.from_ip) {
        if (packet.arrival_s - last_packet_s_ < kSilence_s) {
            ++foreign_ip_;
            return false;
        }
        listener_.remark("the sensor is now at " + captures::ipText(packet.from_ip) +
                         ", no longer at " + captures::ipText(*sensor_ip_));
        sensor_ip_ = packet.from_ip;
    }
    return true;
}

bool LiveSensor::takeVelodyne(const Packet& packet) {
    if (packet.bytes.size() == kPositionBytes) {
        ++position_;
        return false;
    }
    const std::uint8_t* const bytes = packet.bytes.data();
    const observations::VelodyneModel& model = velodyneOf(options_.model);
    const bool is_data = captures::isVelodyneData(bytes, packet.bytes.size());
    const bool is_of_model =
        is_data && (captures::isOfHdl64(bytes) ? &model == &observations::hdl64Model()
                                               : model.id == bytes[captures::kVelodyneModelAt] &&
                                                     &model != &observations::hdl64Model());
    if (is_of_model && !isOfSensor(packet)) return false;
    const bool is_taken =
        velodyne_->add(bytes, packet.bytes.size(), packet.arrival_s) == Taken::Yes;
    if (!recorder_ || !is_of_model) return is_taken;
    captures::VelodynePacket raw;
    std::copy(packet.bytes.begin(), packet.bytes.end(), reinterpret_cast<std::uint8_t*>(&raw.raw));
    raw.time_ns = packet.time_ns;
    turns_->add(raw);
    recordVelodyne();
    return is_taken;
}

bool LiveSensor::takeLivox(const Packet& packet) {
    captures::Datagram datagram;
    datagram.bytes = packet.bytes.data();
    datagram.size = packet.bytes.size();
    if (captures::livoxPacketOf(datagram) && !isOfSensor(packet)) return false;
    return livox_->add(packet.bytes.data(), packet.bytes.size(), packet.arrival_s) ==
           streaming::LivoxStream::Taken::Yes;
}

bool LiveSensor::takeOuster(const Packet& packet) {
    const std::uint8_t* const bytes = packet.bytes.data();
    const captures::OusterSensor& sensor = ouster_->sensor();
    const bool is_packet =
        packet.bytes.size() == sensor.packetBytes() && captures::isOfLidar(bytes, sensor);
    const bool has_serial = !sensor.profile.is_legacy && !sensor.serial.empty();
    if (is_packet && !has_serial && !isOfSensor(packet)) return false;
    const auto taken = ouster_->add(bytes, packet.bytes.size(), packet.arrival_s, packet.time_ns);
    recordOuster();
    return taken == streaming::OusterStream::Taken::Yes;
}

void LiveSensor::recordVelodyne() {
    for (const auto& turn : turns_->complete()) recorder_->add(turn);
    turns_->complete().clear();
}

void LiveSensor::recordOuster() {
    for (const captures::OusterFrame& frame : ouster_->complete()) {
        if (recorder_) recorder_->add(captures::observationOf(frame, ouster_->sensor()));
    }
    ouster_->complete().clear();
}

void LiveSensor::count(LiveReport& r) const {
    if (velodyne_) {
        const auto& counts = velodyne_->counts();
        r.packets = counts.packets;
        r.lost = counts.lost;
        r.late = counts.late;
        r.repeated = counts.repeated;
        r.wrong_size = counts.wrong_size;
        r.foreign = counts.other_model + foreign_ip_;
        r.unsound = counts.unsound;
        r.position = position_;
        r.interruptions = counts.interruptions;
        r.scans = counts.turns;
    } else if (ouster_) {
        const auto& counts = ouster_->counts();
        r.packets = counts.packets;
        r.lost = counts.lost;
        r.late = counts.late;
        r.repeated = counts.repeated;
        r.wrong_size = counts.wrong_size;
        r.position = counts.imu;
        r.foreign = counts.other_sensor + foreign_ip_;
        r.unsound = counts.unsound;
        r.interruptions = counts.interruptions;
        r.scans = counts.turns;
    } else {
        const auto& counts = livox_->counts();
        r.packets = counts.packets;
        r.lost = counts.lost;
        r.late = counts.late;
        r.repeated = counts.repeated;
        r.wrong_size = counts.foreign;
        r.position = counts.imu;
        r.foreign = foreign_ip_;
        r.interruptions = counts.interruptions;
        r.scans = r.sectors / 5;
    }
}

}  // namespace hagen::live
