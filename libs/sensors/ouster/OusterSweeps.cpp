#include "sensors/SweepReader.h"
#include "sensors/ouster/OusterFrames.h"
#include "sensors/ouster/OusterScan.h"

#include <optional>

namespace hagen::sensors {
namespace {

/// Reads the frames of one Ouster in a recording.
class OusterSweeps : public SweepReader {
 public:
    explicit OusterSweeps(const std::filesystem::path& sensor_json)
        : json_(sensor_json), sensor_(readOusterSensor(sensor_json)) {}

    void add(const Datagram& datagram) override {
        switch (kindOf(datagram, sensor_)) {
            case OusterPacketKind::Imu:
                ++imu_packets_;
                return;
            case OusterPacketKind::Other:
                return others_.add(datagram);
            case OusterPacketKind::OtherSensor:
                ++other_sensors_;
                other_serial_ = serialOf(datagram.bytes, sensor_);
                return;
            case OusterPacketKind::Lidar:
                break;
        }
        if (from_ip_.value_or(datagram.from_ip) != datagram.from_ip) {
            ++other_sources_;
            return;
        }
        from_ip_ = datagram.from_ip;
        frames_.add(datagram.bytes, datagram.time_ns);
        collect();
    }

    void finish() override {
        frames_.finish();
        collect();
    }

    std::vector<std::string> remarks() const override {
        return {"ouster (" + sensor_.name + ", " + sensor_.profile.name +
                "): " + textOf(frames_.counts())};
    }

    std::string ignored() const override {
        std::string text;
        addCount(imu_packets_, "IMU packet", "", text);
        addCount(other_sensors_, "packet",
                 "from another sensor (serial number " + std::to_string(other_serial_) + ")", text);
        addCount(other_sources_, "packet", "from another address", text);
        others_.describe(text);
        return text;
    }

    std::string whyEmpty(const std::string& losses) const override {
        if (frames_.counts().frames > 0) return "";
        if (frames_.counts().packets > 0) {
            return "its turns do not have the " + std::to_string(sensor_.columns_per_frame) +
                   " columns in " + json_.string() + ". Are the metadata from another mode?";
        }
        const std::string found = joined(ignored(), losses);
        return "has no packets from the " + sensor_.name +
               (sensor_.serial.empty() ? "" : " with serial number " + sensor_.serial) + " in " +
               json_.string() + " (" + std::to_string(sensor_.packetBytes()) + " bytes, profile " +
               sensor_.profile.name + "); it has " + (found.empty() ? "no frames" : found) +
               ". Is it another sensor's metadata?";
    }

 private:
    void collect() {
        for (const OusterFrame& frame : frames_.complete()) {
            complete_.push_back(sweepOf(frame, sensor_));
        }
        frames_.complete().clear();
    }

    std::filesystem::path json_;
    OusterSensor sensor_;
    OusterFrames frames_{sensor_};
    std::optional<IpAddress> from_ip_;  ///< the sensor's address, if known
    std::uint64_t other_serial_ = 0;
    std::size_t imu_packets_ = 0, other_sensors_ = 0, other_sources_ = 0;
};

}  // namespace

LidarSweep sweepOf(const OusterFrame& frame, const OusterSensor& sensor) {
    LidarSweep sweep;
    sweep.label = "ouster";
    sweep.time_ns = frame.time_ns;
    sweep.sensor = sensor.model;
    sweep.origin_m = sensor.lidar_to_sensor.translation();
    sweep.returns = scanOf(frame, sensor);
    return sweep;
}

std::string textOf(const OusterFrames::Counts& counts) {
    std::string text = counted(counts.packets, "packet") + " in " + counted(counts.frames, "turn");
    addCount(counts.lost_frames, "turn", "lost", text);
    addCount(counts.uncertain_frames, "turn", "dropped, because columns may not match the metadata",
             text);
    addCount(counts.missing_columns, "column", "missing", text);
    addCount(counts.invalid_columns, "column", "marked invalid by the sensor, dropped", text);
    addCount(counts.wrong_columns, "column", "with an invalid number, dropped", text);
    addCount(counts.repeated_columns, "duplicate column", "dropped", text);
    addCount(counts.late_packets, "packet", "more than a turn late, dropped", text);
    return text;
}

std::unique_ptr<SweepReader> makeOusterSweeps(const std::filesystem::path& sensor_json) {
    return std::make_unique<OusterSweeps>(sensor_json);
}

}  // namespace hagen::sensors
