#include <hagen/scan/Angle.h>
#include <hagen/sensors/LidarDriver.h>
#include "sensors/ouster/OusterFrames.h"
#include "sensors/ouster/OusterScan.h"
#include "sensors/ouster/OusterSensor.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hagen::sensors {
namespace {

constexpr long long kMaxLatePackets = 16;  // packets
constexpr int kMaxTurns = 2;               // a longer gap is an interruption

/// Reads the packets of one Ouster. Returns are relative to the origin of the beams (in the lidar
/// frame, with the axes of the sensor frame). Counts missing packets of complete turns after the
/// first as lost, and jumps by more than two turns as interruptions.
class OusterDriver : public LidarDriver {
 public:
    explicit OusterDriver(const OusterSensor& sensor) : sensor_(sensor) {
        const Eigen::Matrix3d turned = sensor_.lidar_to_sensor.linear();
        ahead_rad_ = -std::atan2(turned(1, 0), turned(0, 0));
    }

    OusterDriver(const OusterDriver&) = delete;
    OusterDriver& operator=(const OusterDriver&) = delete;

    SensorModel sensor() const override { return *sensor_.model; }
    BeamOffsets beamOffsets(double /*min_range_m*/) const override {
        BeamOffsets offsets;
        for (const double azimuth_rad : sensor_.azimuth_rad) {
            const double behind_rad = std::remainder(azimuth_rad, 2 * kPi);
            offsets.behind_rad = std::max(offsets.behind_rad, behind_rad);
            offsets.ahead_rad = std::max(offsets.ahead_rad, -behind_rad);
        }
        return offsets;
    }

    bool isData(const Datagram& datagram) const override {
        return kindOf(datagram, sensor_) == OusterPacketKind::Lidar;
    }

    bool hasSerial() const override { return sensor_.hasSerial(); }
    Taken add(const Datagram& datagram, double arrival_s, ReturnSink& sink) override {
        switch (kindOf(datagram, sensor_)) {
            case OusterPacketKind::Imu:
                ++counts_.auxiliary;
                return Taken::Auxiliary;
            case OusterPacketKind::Other:
                ++counts_.wrong_size;
                return Taken::WrongSize;
            case OusterPacketKind::OtherSensor:
                ++counts_.other_sensor;
                return Taken::OtherSensor;
            case OusterPacketKind::Lidar:
                break;
        }
        const std::size_t repeated = frames_.counts().repeated_columns;
        const OusterFrame* const frame = frames_.add(datagram.bytes, datagram.time_ns, &columns_);
        frames_.complete().clear();
        countLosses();
        if (frame == nullptr) {
            ++counts_.late;
            ++counts_.too_late;
            return Taken::TooLate;
        }
        counts_.restarts = frames_.restarts();
        if (frame->is_uncertain) {
            // The column directions of this and the previous packets are unknown.
            if (!is_uncertain_) sink.restart();
            is_uncertain_ = true;
            has_last_ = false;
            ++counts_.uncertain;
            return Taken::Uncertain;
        }
        is_uncertain_ = false;
        const bool is_duplicate = columns_.empty() && frames_.counts().repeated_columns > repeated;
        return takeColumns(*frame, is_duplicate, arrival_s, sink);
    }

    void finish() override {
        frames_.finish();
        frames_.complete().clear();
    }

 private:
    Taken takeColumns(const OusterFrame& frame, bool is_duplicate, double arrival_s,
                      ReturnSink& sink) {
        const int step = has_last_ ? OusterFrames::stepOf(last_id_, frame.id) : 0;
        if (std::abs(step) > kMaxTurns) {  // not a late packet
            ++counts_.interruptions;
            sink.restart();
            has_last_ = false;
        }
        if (is_duplicate) {
            ++counts_.duplicate;
            return Taken::Duplicate;
        }
        const auto isInvalid = [&](std::size_t column) {
            return frame.state[column] != OusterFrame::Column::Valid;
        };
        columns_.erase(std::remove_if(columns_.begin(), columns_.end(), isInvalid), columns_.end());
        if (columns_.empty()) {
            ++counts_.unsound;
            return Taken::Unsound;
        }
        const auto columns = static_cast<long long>(sensor_.columns_per_frame);
        const auto of_packet = static_cast<long long>(sensor_.columns_per_packet);
        const long long turn = has_last_ ? turn_ + step : 0;
        const long long at = turn * columns + static_cast<long long>(columns_.front());
        if (has_last_ && at < last_at_) {
            ++counts_.late;
            if (last_at_ - at > std::min(kMaxLatePackets * of_packet, columns / 2)) {
                ++counts_.too_late;
                return Taken::TooLate;
            }
        } else {
            has_last_ = true;
            last_id_ = frame.id;
            turn_ = turn;
            last_at_ = at;
        }
        ++counts_.packets;
        addRuns(frame, turn, arrival_s, sink);
        return Taken::Yes;
    }

    /// Counts missing packets once a turn is complete, except in the first turn, which may have
    /// begun before recording.
    void countLosses() {
        const OusterFrames::Counts& frames = frames_.counts();
        if (frames.frames == counts_.scans) return;
        if (counts_.scans == 0) missing_of_first_ = frames.missing_columns;
        counts_.scans = frames.frames;
        counts_.lost = (frames.missing_columns - missing_of_first_ +
                        frames.lost_frames * sensor_.windowColumns()) /
                       sensor_.columns_per_packet;
    }

    /// Adds each run of consecutive columns as a sweep.
    void addRuns(const OusterFrame& frame, long long turn, double arrival_s, ReturnSink& sink) {
        const double column_rad = 2 * kPi / static_cast<double>(sensor_.columns_per_frame);
        const double turned_rad = ahead_rad_ + 2 * kPi * static_cast<double>(turn);
        for (auto first = columns_.begin(); first != columns_.end();) {
            auto end = std::next(first);
            while (end != columns_.end() && *end == *std::prev(end) + 1) ++end;
            run_.assign(first, end);
            scanColumns(frame, sensor_, run_, returns_);
            sink.add(returns_,
                     {turned_rad + column_rad * static_cast<double>(run_.front()),
                      turned_rad + column_rad * static_cast<double>(run_.back() + 1)},
                     arrival_s);
            first = end;
        }
    }

    const OusterSensor sensor_;
    OusterFrames frames_{sensor_};
    double ahead_rad_;  ///< clockwise from the sensor's x axis to column 0
    bool has_last_ = false, is_uncertain_ = false;
    std::uint16_t last_id_ = 0;  ///< frame ID of the latest packet
    long long turn_ = 0;         ///< accumulated turns
    long long last_at_ = 0;      ///< accumulated columns at the latest packet's first column
    std::size_t missing_of_first_ = 0;
    std::vector<std::size_t> columns_, run_;
    Scan returns_;
};

}  // namespace

std::unique_ptr<LidarDriver> makeOusterDriver(const OusterSensor& sensor) {
    return std::make_unique<OusterDriver>(sensor);
}

}  // namespace hagen::sensors
