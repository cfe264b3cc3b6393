#include "sensors/ouster/OusterColumns.h"

#include <cmath>

#include "sensors/LittleEndian.h"

namespace hagen::sensors {
namespace {

constexpr double kEncoderTicks = 90112;  // per turn
constexpr double kTolerance = 0.15;      // captures deviate by up to 0.01
constexpr int kMaxNumber = 64;           // max. increment between consecutive packets
constexpr int kMaxLateTurns = 16;        // max. age of a late packet; older columns mean a restart
constexpr std::uint16_t kMaxColumns = 4096;

}  // namespace

/// Finds the first and last valid column of a packet. Returns false if no column number is within
/// the metadata's range.
bool OusterColumns::readColumns(const std::uint8_t* packet) {
    if (last_) before_ = last_;
    first_.reset();
    last_.reset();
    bool has_number = false;
    const std::uint16_t frame = frameIdOf(packet, sensor_);
    for (std::size_t c = 0; c < sensor_.columns_per_packet; ++c) {
        const std::uint8_t* const at = sensor_.columnOf(packet, c);
        Column column;
        column.frame = frame;
        column.time_ns = little<std::uint64_t>(at);
        column.number = little<std::uint16_t>(at + 8);
        if (sensor_.profile.is_legacy) column.encoder = little<std::uint32_t>(at + 12);
        has_number = has_number || column.number < sensor_.columns_per_frame;
        if (!sensor_.isValid(at)) continue;
        if (!first_) first_ = column;
        last_ = column;
    }
    return has_number;
}

/// Stores a column. Returns the same column of one of the two previous turns, if received.
std::optional<OusterColumns::Column> OusterColumns::replace(const Column& column) {
    if (of_turn_.size() <= column.number) of_turn_.resize(column.number + std::size_t{1});
    std::optional<Column>& latest = of_turn_[column.number];
    const std::optional<Column> before = latest;
    const int turns = before ? turnsBetween(*before, column) : 0;
    const bool is_late = before && turns <= 0 && turns > -kMaxLateTurns;  // late or duplicate
    if (!is_late) latest = column;
    return turns == 1 || turns == 2 ? before : std::nullopt;
}

int OusterColumns::turnsBetween(const Column& from, const Column& to) {
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(to.frame - from.frame));
}

/// `ratio`: apparent number of columns per turn divided by that in the metadata.
OusterColumns::Evidence OusterColumns::evidenceOf(double ratio) {
    const auto isNear = [&](double other) { return std::abs(ratio / other - 1) < kTolerance; };
    if (isNear(1)) return Evidence::Same;
    for (const double other : {0.125, 0.25, 0.5, 2.0, 4.0, 8.0}) {
        if (isNear(other)) return Evidence::Other;
    }
    return Evidence::None;
}

OusterColumns::Evidence OusterColumns::evidence() {
    if (!first_ || first_->number >= kMaxColumns) return Evidence::None;
    Column from = *first_;
    if (from.number == last_->number && before_) from = *before_;  // packets have one column
    const int columns = last_->number - from.number;
    if (from.frame != last_->frame || columns <= 0 || columns > kMaxNumber) return Evidence::None;
    const double all = static_cast<double>(sensor_.columns_per_frame) / columns;
    first_->all_ns =
        all * static_cast<double>(static_cast<std::int64_t>(last_->time_ns - from.time_ns));
    const std::optional<Column> before = replace(*first_);
    if (sensor_.profile.is_legacy) {
        const double turned = std::remainder(
            static_cast<double>(last_->encoder) - static_cast<double>(from.encoder), kEncoderTicks);
        const Evidence by_angle = evidenceOf(kEncoderTicks / (all * turned));
        if (by_angle != Evidence::None) return by_angle;
    }
    if (before) {
        has_compared_ = true;
        const int turns = turnsBetween(*before, *first_);
        const auto since_ns = static_cast<std::int64_t>(first_->time_ns - before->time_ns);
        const Evidence by_turn = evidenceOf(static_cast<double>(since_ns) / turns / first_->all_ns);
        // During a mode change, a turn may take an arbitrary time.
        const bool is_steady = std::abs(before->all_ns / first_->all_ns - 1) < kTolerance;
        return by_turn == Evidence::Same && !is_steady ? Evidence::None : by_turn;
    }
    // A faster turn with fewer columns may have the same column interval.
    const Evidence by_mode = evidenceOf(1e9 * sensor_.turn_s / first_->all_ns);
    return has_compared_ || by_mode != Evidence::Other ? Evidence::None : Evidence::Other;
}

bool OusterColumns::take(const std::uint8_t* packet) {
    const std::optional<std::uint32_t> initialization = initializationOf(packet, sensor_);
    if (initialization_ && initialization != initialization_) {
        ++restarts_;
        is_certain_ = has_compared_ = false;
        of_turn_.clear();
        last_.reset();
        before_.reset();
    }
    initialization_ = initialization;
    const bool has_number = readColumns(packet);
    const Evidence found = evidence();
    if (found == Evidence::Same) is_certain_ = true;
    if (found == Evidence::Other || !has_number) is_certain_ = false;
    return is_certain_;
}

}  // namespace hagen::sensors
