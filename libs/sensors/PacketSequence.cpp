#include "sensors/PacketSequence.h"

#include <algorithm>

#include "sensors/captures/Remarks.h"

namespace hagen::sensors {
namespace {

constexpr std::uint64_t kInterruption_ns = 1000000000;
constexpr std::uint64_t kMaxLate_ns = 16 * 480000;  // 16 Livox packets
constexpr std::size_t kLateOfSetClock = 4;          // consecutive packets

}  // namespace

/// True if several late packets arrive in quick succession, which means that the clock was set
/// back; the network may delay single packets.
bool PacketSequence::wentBack(std::uint64_t time_ns) {
    const bool follows =
        too_late_in_a_row_ > 0 && time_ns > too_late_ns_ && time_ns - too_late_ns_ <= kMaxLate_ns;
    too_late_in_a_row_ = follows ? too_late_in_a_row_ + 1 : 1;
    too_late_ns_ = time_ns;
    return too_late_in_a_row_ >= kLateOfSetClock;
}

PacketSequence::Step PacketSequence::stepTo(std::uint16_t number, std::uint64_t time_ns,
                                            PacketCounts& counts) {
    if (!has_last_) return Step::Next;
    const auto step = static_cast<std::int16_t>(static_cast<std::uint16_t>(number - last_number_));
    const bool is_earlier = time_ns < last_ns_;
    const std::uint64_t gap_ns = is_earlier ? last_ns_ - time_ns : time_ns - last_ns_;
    const bool is_too_late = drops_late_ && is_earlier && gap_ns > kMaxLate_ns;
    if (is_too_late && !wentBack(time_ns)) {
        ++counts.late;
        ++counts.too_late;
        return Step::TooLate;
    }
    too_late_in_a_row_ = 0;
    if (gap_ns > kInterruption_ns || is_too_late) {
        ++counts.interruptions;
        return Step::Interruption;
    }
    if (is_earlier) {
        ++counts.late;
        if (step < 0 && counts.lost > 0) --counts.lost;
        return Step::Late;
    }
    // Some firmware restarts the sequence numbers with each frame.
    if (step > 1) counts.lost += static_cast<std::size_t>(step - 1);
    return Step::Next;
}

PacketSequence::Step PacketSequence::add(std::uint16_t number, std::uint64_t time_ns,
                                         double arrival_s, PacketCounts& counts) {
    const std::uint64_t key = time_ns << 16 | number;
    if (recent_.has(key, arrival_s)) {
        // Duplicates of packets other than the late ones show that the clock was not set back.
        const std::uint64_t apart_ns =
            std::max(time_ns, too_late_ns_) - std::min(time_ns, too_late_ns_);
        if (apart_ns > kMaxLate_ns) too_late_in_a_row_ = 0;
        ++counts.duplicate;
        return Step::Duplicate;
    }
    recent_.add(key, arrival_s);
    const Step step = stepTo(number, time_ns, counts);
    if (step == Step::Next || step == Step::Interruption) {
        has_last_ = true;
        last_ns_ = time_ns;
        last_number_ = number;
    }
    if (step != Step::TooLate) ++counts.packets;
    return step;
}

std::string describe(const PacketCounts& counts, const char* scan) {
    std::string text = counted(counts.packets, "packet") + " in " + counted(counts.scans, scan);
    addCount(counts.lost, "packet", "lost", text);
    addCount(counts.late, "packet", "out of order, kept in the scan in which it arrived", text);
    addCount(counts.duplicate, "duplicate packet", "dropped", text);
    addCount(counts.interruptions, "interruption", "(gap or clock jump)", text);
    return text;
}

}  // namespace hagen::sensors
