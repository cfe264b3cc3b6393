#include "sensors/ouster/OusterFrames.h"

#include <algorithm>

#include "sensors/LittleEndian.h"

namespace hagen::sensors {
namespace {

constexpr std::size_t kMaxOpen = 2;
constexpr std::size_t kMaxConsecutiveLate = 16;  // packets
constexpr int kMaxStep = 600;  // 60 s at 10 Hz; a larger step means another recording

OusterFrame emptyFrame(const OusterSensor& sensor, std::uint16_t id, std::int64_t time_ns) {
    OusterFrame frame;
    frame.id = id;
    frame.time_ns = time_ns;
    frame.columns = sensor.columns_per_frame;
    frame.state.resize(frame.columns, OusterFrame::Column::Missing);
    frame.column_time_ns.resize(frame.columns);
    const std::size_t all = sensor.pixels * frame.columns;
    frame.range.resize(all);
    frame.reflectivity.resize(all);
    if (sensor.profile.second_at > 0) {
        frame.second_range.resize(all);
        frame.second_reflectivity.resize(all);
    }
    return frame;
}

}  // namespace

const OusterFrame* OusterFrames::add(const std::uint8_t* packet, std::int64_t time_ns,
                                     std::vector<std::size_t>* taken) {
    if (taken != nullptr) taken->clear();
    ++counts_.packets;
    const bool is_certain = columns_.take(packet);
    OusterFrame* const frame = frameOf(frameIdOf(packet, sensor_), time_ns);
    if (frame == nullptr) {
        ++counts_.late_packets;
        if (++late_in_a_row_ >= kMaxConsecutiveLate) restart();
        return nullptr;
    }
    late_in_a_row_ = 0;
    if (!is_certain) frame->is_uncertain = true;
    for (std::size_t c = 0; c < sensor_.columns_per_packet; ++c) {
        std::size_t number = 0;
        const bool is_new = readColumn(sensor_.columnOf(packet, c), number, *frame);
        if (is_new && taken != nullptr && !frame->is_uncertain) taken->push_back(number);
    }
    return frame;
}

/// Returns the open or new frame with this ID; null if that frame is already complete.
OusterFrame* OusterFrames::frameOf(std::uint16_t id, std::int64_t time_ns) {
    const std::uint16_t newest = open_.empty() ? last_id_ : open_.back().id;
    const bool has_newest = has_last_ || !open_.empty();
    if (has_newest && std::abs(stepOf(newest, id)) > kMaxStep) restart();
    for (OusterFrame& frame : open_) {
        if (frame.id == id) return &frame;
    }
    if (has_last_ && stepOf(last_id_, id) <= 0) return nullptr;
    if (open_.size() == kMaxOpen) {
        if (stepOf(open_.front().id, id) < 0) return nullptr;
        completeFirst();
    }
    const auto place = std::find_if(open_.begin(), open_.end(), [&](const OusterFrame& frame) {
        return stepOf(id, frame.id) > 0;
    });
    return &*open_.insert(place, emptyFrame(sensor_, id, time_ns));
}

/// Reads a column. Returns true if the column is new in the frame.
bool OusterFrames::readColumn(const std::uint8_t* column, std::size_t& number, OusterFrame& frame) {
    const OusterProfile& profile = sensor_.profile;
    number = little<std::uint16_t>(column + 8);
    if (number >= frame.columns) {
        ++counts_.wrong_columns;
        return false;
    }
    if (frame.state[number] != OusterFrame::Column::Missing) {
        ++counts_.repeated_columns;
        return false;
    }
    constexpr std::size_t kHeader = 12, kLegacyHeader = 16;
    const std::uint8_t* const pixels = column + (profile.is_legacy ? kLegacyHeader : kHeader);
    frame.state[number] =
        sensor_.isValid(column) ? OusterFrame::Column::Valid : OusterFrame::Column::Invalid;
    frame.column_time_ns[number] = little<std::uint64_t>(column);
    for (std::size_t p = 0; p < sensor_.pixels; ++p) {
        const std::uint8_t* const pixel = pixels + p * profile.pixel_bytes;
        const std::size_t at = frame.at(p, number);
        frame.range[at] = little<std::uint32_t>(pixel) & profile.range_mask;
        frame.reflectivity[at] = pixel[profile.reflectivity_at];
        if (profile.second_at == 0) continue;
        frame.second_range[at] =
            little<std::uint32_t>(pixel + profile.second_at) & profile.range_mask;
        frame.second_reflectivity[at] = pixel[profile.second_reflectivity_at];
    }
    return true;
}

void OusterFrames::completeFirst() {
    OusterFrame& frame = open_.front();
    if (has_last_) counts_.lost_frames += static_cast<std::size_t>(stepOf(last_id_, frame.id) - 1);
    has_last_ = true;
    last_id_ = frame.id;
    if (frame.is_uncertain) {
        ++counts_.uncertain_frames;
        open_.pop_front();
        return;
    }
    ++counts_.frames;
    std::size_t present = 0;
    for (const OusterFrame::Column state : frame.state) {
        present += state != OusterFrame::Column::Missing;
        counts_.invalid_columns += state == OusterFrame::Column::Invalid;
    }
    counts_.missing_columns += sensor_.windowColumns() - std::min(present, sensor_.windowColumns());
    complete_.push_back(std::move(frame));
    open_.pop_front();
}

void OusterFrames::finish() {
    while (!open_.empty()) completeFirst();
}

void OusterFrames::restart() {
    finish();
    has_last_ = false;
    late_in_a_row_ = 0;
}

}  // namespace hagen::sensors
