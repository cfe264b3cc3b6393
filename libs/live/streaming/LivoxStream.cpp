#include <hagen/live/LivoxStream.h>
#include <hagen/scan/Airframe.h>

#include <algorithm>
#include <utility>

#include "live/streaming/CheckTime.h"

namespace hagen::live {
namespace {

constexpr std::uint64_t kInterruption_ns = 1000000000;
constexpr std::uint64_t kMostLate_ns = 16 * 480000;  // sixteen packets
constexpr std::size_t kOfSetClock = 4;               // packets in a row
constexpr double kLongestFrame = 2;                  // times as long as usual, by arrival
constexpr double kPointInterval_s = 5e-6;            // of a Mid-360, where a packet does not say it
constexpr std::size_t kMostPackets = 1000;  // of a frame, whatever the clock says; usual are 42

}  // namespace

LivoxStream::LivoxStream(const Settings& settings, StreamingSegmenter::Take take, double frame_s,
                         double window_s)
    : settings_(settings), frame_s_(frame_s) {
    SensorModel sensor = sensorModel("Mid-360");
    sensor.min_range_m = settings.sensor.min_range_m.value_or(sensor.min_range_m);
    sensor.max_range_m = settings.sensor.max_range_m.value_or(sensor.max_range_m);
    filterFor(sensor, settings.options);  // throws SettingsError
    StreamingOptions streaming;
    // As context, a frame counts as old as its last packet.
    streaming.context_s = window_s - frame_s / 2;
    segmenter_ = std::make_unique<StreamingSegmenter>(std::move(sensor), settings.options,
                                                      std::move(take), streaming);
    segmenter_->setMount(settings_.tiltOnLevelVehicle());
}

void LivoxStream::setAttitude(const std::optional<Attitude>& attitude) {
    segmenter_->setAttitude(attitude);
}

void LivoxStream::setPose(const std::optional<Eigen::Isometry3d>& map_from_sensor) {
    segmenter_->setPose(map_from_sensor);
}

/// By a packet that is too late. One that is alone waited in a network; several in a row, one
/// shortly after the other, are of a clock that was set back: nothing else comes any more.
bool LivoxStream::wentBack(std::uint64_t time_ns) {
    const bool follows =
        too_late_in_a_row_ > 0 && time_ns > too_late_ns_ && time_ns - too_late_ns_ <= kMostLate_ns;
    too_late_in_a_row_ = follows ? too_late_in_a_row_ + 1 : 1;
    too_late_ns_ = time_ns;
    return too_late_in_a_row_ >= kOfSetClock;
}

LivoxStream::Taken LivoxStream::add(const std::uint8_t* bytes, std::size_t size, double arrival_s) {
    checkTime(arrival_s);
    // The sensor was silent, or its clock stood still: what came before has waited for its labels,
    // and is not as new as what comes now.
    if (is_begun_ && arrival_s - first_arrival_s_ > kLongestFrame * frame_s_) flush();
    sensors::Datagram datagram;
    datagram.bytes = bytes;
    datagram.size = size;
    if (sensors::isLivoxImu(datagram)) {
        ++counts_.imu;
        return Taken::Imu;
    }
    const auto packet = sensors::livoxPacketOf(datagram);
    if (!packet) {
        ++counts_.foreign;
        return Taken::Foreign;
    }
    // A copy measured nothing: where packets are lost, copies of others do not make up for them.
    const std::uint64_t key = packet->time_ns << 16 | packet->number;
    if (recent_.has(key, arrival_s)) {
        // Where all packets come twice, those of a clock that was set back do, too.
        const std::uint64_t apart_ns =
            std::max(packet->time_ns, too_late_ns_) - std::min(packet->time_ns, too_late_ns_);
        if (apart_ns > kMostLate_ns) too_late_in_a_row_ = 0;
        ++counts_.repeated;
        return Taken::Repeated;
    }
    recent_.add(key, arrival_s);
    bool is_late = false;
    if (has_last_) {
        const auto step =
            static_cast<std::int16_t>(static_cast<std::uint16_t>(packet->number - last_number_));
        const bool is_earlier = packet->time_ns < last_ns_;
        const std::uint64_t gap_ns =
            is_earlier ? last_ns_ - packet->time_ns : packet->time_ns - last_ns_;
        const bool is_too_late = is_earlier && gap_ns > kMostLate_ns;
        if (is_too_late && !wentBack(packet->time_ns)) {
            ++counts_.too_late;
            return Taken::TooLate;
        }
        too_late_in_a_row_ = 0;
        if (gap_ns > kInterruption_ns || is_too_late) {
            ++counts_.interruptions;
            flush();
            segmenter_->restart();
        } else if (is_earlier) {
            is_late = true;
            ++counts_.late;
            if (step < 0 && counts_.lost > 0) --counts_.lost;
        } else if (step > 1) {
            // The number starts again with each frame of some firmware.
            counts_.lost += static_cast<std::size_t>(step - 1);
        }
    }
    if (!is_begun_) {
        is_begun_ = true;
        start_ns_ = packet->time_ns;
        first_arrival_s_ = arrival_s;
    }
    if (!is_late) {
        has_last_ = true;
        last_ns_ = packet->time_ns;
        last_number_ = packet->number;
    }
    ++counts_.packets;
    ++packets_of_frame_;
    last_arrival_s_ = arrival_s;
    appendPoints(*packet, start_ns_, frame_, tags_);
    const double interval_s =
        packet->point_interval_s > 0 ? packet->point_interval_s : kPointInterval_s;
    const double packet_s = interval_s * static_cast<double>(packet->count);
    measured_s_ += packet_s;
    const bool is_whole =
        last_ns_ >= start_ns_ &&
        1e-9 * static_cast<double>(last_ns_ - start_ns_) + 1.5 * packet_s > frame_s_;
    if (is_whole || packets_of_frame_ >= kMostPackets) flush();
    return Taken::Yes;
}

void LivoxStream::flush() {
    if (!is_begun_) return;
    is_begun_ = false;
    packets_of_frame_ = 0;
    locateBeams(segmenter_->sensor(), frame_);
    counts_.returns_masked += maskAirframe(settings_.airframe.parts, frame_);
    segmenter_->addFrame(frame_, last_arrival_s_, std::exchange(measured_s_, 0), first_arrival_s_,
                         1e-9 * static_cast<double>(start_ns_));
    frame_.clear();
    tags_.clear();
}

}  // namespace hagen::live
