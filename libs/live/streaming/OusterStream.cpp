#include <hagen/live/OusterStream.h>
#include <hagen/scan/Airframe.h>
#include <hagen/scan/Angle.h>
#include <hagen/sensors/OusterScan.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <string>
#include <utility>

#include "live/streaming/CheckTime.h"

namespace hagen::live {
namespace {

constexpr long long kMostLate = 16;  // packets
constexpr int kMostTurns = 2;        // missing; more: the sensor was started again
constexpr std::size_t kImuBytes = 48;

/// Where the pixels look.
BeamOffsets offsetsOf(const sensors::OusterSensor& sensor) {
    BeamOffsets offsets;
    for (const double azimuth_rad : sensor.azimuth_rad) {
        const double behind_rad = std::remainder(azimuth_rad, 2 * kPi);
        offsets.behind_rad = std::max(offsets.behind_rad, behind_rad);
        offsets.ahead_rad = std::max(offsets.ahead_rad, -behind_rad);
    }
    return offsets;
}

/// From one frame id to another; ids wrap.
int stepOf(std::uint16_t from, std::uint16_t to) {
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(to - from));
}

}  // namespace

OusterStream::OusterStream(const sensors::OusterSensor& sensor, const Settings& settings,
                           StreamingSegmenter::Take take, const StreamingOptions& streaming)
    : sensor_(sensor), settings_(settings), frames_(sensor_) {
    SensorModel model = *sensor_.model;
    model.min_range_m = settings.sensor.min_range_m.value_or(model.min_range_m);
    model.max_range_m = settings.sensor.max_range_m.value_or(model.max_range_m);
    filterFor(model, settings.options);  // throws SettingsError
    segmenter_ = std::make_unique<StreamingSegmenter>(std::move(model), settings.options,
                                                      std::move(take), streaming);
    const Eigen::Matrix3d turned = sensor_.lidar_to_sensor.linear();
    ahead_rad_ = -std::atan2(turned(1, 0), turned(0, 0));
    segmenter_->setBeamOffsets(offsetsOf(sensor_));
    segmenter_->setMount(settings_.tiltOnLevelVehicle());
}

void OusterStream::setAttitude(const std::optional<Attitude>& attitude) {
    segmenter_->setAttitude(attitude);
}

void OusterStream::setPose(const std::optional<Eigen::Isometry3d>& map_from_sensor) {
    segmenter_->setPose(map_from_sensor);
}

/// What is missing is known when a turn is complete. The first one may have begun before.
void OusterStream::countLosses() {
    const auto& frames = frames_.counts();
    if (frames.frames == counts_.turns) return;
    if (counts_.turns == 0) missing_of_first_ = frames.missing_columns;
    counts_.turns = frames.frames;
    counts_.lost = (frames.missing_columns - missing_of_first_ +
                    frames.lost_frames * sensor_.windowColumns()) /
                   sensor_.columns_per_packet;
}

OusterStream::Taken OusterStream::add(const std::uint8_t* bytes, std::size_t size, double arrival_s,
                                      std::int64_t time_ns) {
    checkTime(arrival_s);
    if (size == kImuBytes) {
        ++counts_.imu;
        return Taken::Imu;
    }
    if (size != sensor_.packetBytes() || !sensors::isOfLidar(bytes, sensor_)) {
        ++counts_.wrong_size;
        return Taken::WrongSize;
    }
    const bool has_serial = !sensor_.profile.is_legacy && !sensor_.serial.empty();
    if (has_serial && std::to_string(sensors::serialOf(bytes, sensor_)) != sensor_.serial) {
        ++counts_.other_sensor;
        return Taken::OtherSensor;
    }
    const std::size_t repeated = frames_.counts().repeated_columns;
    const sensors::OusterFrame* const frame = frames_.add(bytes, time_ns, &columns_);
    countLosses();
    if (frame == nullptr) {
        ++counts_.late;
        ++counts_.too_late;
        return Taken::Late;
    }
    counts_.restarts = frames_.restarts();
    if (frame->is_uncertain) {
        // Nothing is known of where the sensor looks, nor where it has looked in this turn.
        if (!is_uncertain_) segmenter_->restart();
        is_uncertain_ = true;
        has_last_ = false;
        ++counts_.uncertain;
        return Taken::Uncertain;
    }
    is_uncertain_ = false;
    const std::uint16_t id = frame->id;
    const int step = has_last_ ? stepOf(last_id_, id) : 0;
    if (std::abs(step) > kMostTurns) {  // and not one that is only late
        ++counts_.interruptions;
        segmenter_->restart();
        has_last_ = false;
    }
    if (columns_.empty()) {
        const bool is_repeated = frames_.counts().repeated_columns > repeated;
        ++(is_repeated ? counts_.repeated : counts_.unsound);
        return is_repeated ? Taken::Repeated : Taken::Unsound;
    }
    // Where the sensor says that a column is invalid, it has not looked.
    const auto isInvalid = [&](std::size_t column) {
        return frame->state[column] != sensors::OusterFrame::Column::Valid;
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
        if (last_at_ - at > std::min(kMostLate * of_packet, columns / 2)) {
            ++counts_.too_late;
            return Taken::Late;
        }
    } else {
        has_last_ = true;
        last_id_ = id;
        turn_ = turn;
        last_at_ = at;
    }
    ++counts_.packets;
    addRuns(*frame, turn, arrival_s);
    return Taken::Yes;
}

/// Each run of columns that follow each other is a sweep.
void OusterStream::addRuns(const sensors::OusterFrame& frame, long long turn, double arrival_s) {
    const double column_rad = 2 * kPi / static_cast<double>(sensor_.columns_per_frame);
    const double turned_rad = ahead_rad_ + 2 * kPi * static_cast<double>(turn);
    for (auto first = columns_.begin(); first != columns_.end();) {
        auto end = std::next(first);
        while (end != columns_.end() && *end == *std::prev(end) + 1) ++end;
        run_.assign(first, end);
        sensors::scanColumns(frame, sensor_, run_, returns_);
        counts_.returns_masked += maskAirframe(settings_.airframe.parts, returns_);
        segmenter_->add(returns_,
                        {turned_rad + column_rad * static_cast<double>(run_.front()),
                         turned_rad + column_rad * static_cast<double>(run_.back() + 1)},
                        arrival_s);
        first = end;
    }
}

}  // namespace hagen::live
