#include "live/mavlink/Parser.h"

#include <algorithm>

#include "live/mavlink/Wire.h"

namespace hagen::mavlink {

/// Counts gaps in the sequence. Gaps above half the range are restarts or late messages.
void Parser::countLost(const Frame& frame) {
    const auto sender = std::make_pair(frame.system, frame.component);
    const auto last = sequences_.find(sender);
    if (last != sequences_.end()) {
        const auto missing = static_cast<std::uint8_t>(frame.sequence - last->second - 1);
        if (missing < 128) counts_.lost += missing;
    }
    sequences_[sender] = frame.sequence;
}

/// Processes the frame at `at`. Returns the number of bytes processed; 0 if the frame is
/// incomplete.
std::size_t Parser::takeOne(std::size_t at, bool is_at_end, const Take& take) {
    const std::uint8_t* const bytes = &waiting_[at];
    const std::size_t size = waiting_.size() - at;
    const auto none = [&](std::size_t& count) {
        ++count;
        return std::size_t{1};
    };
    const bool is_old = bytes[0] == kStart1;
    if (bytes[0] != kStart && !is_old) return none(counts_.skipped_bytes);
    const std::size_t incomplete = is_at_end ? 1 : 0;
    const std::size_t header = is_old ? kHeaderBytes1 : kHeaderBytes;
    if (size < header) {
        counts_.skipped_bytes += incomplete;
        return incomplete;
    }
    Frame frame;
    const std::uint8_t flags = is_old ? 0 : bytes[2];
    const std::uint8_t* const sent = bytes + (is_old ? 2 : 4);
    frame.version = is_old ? 1 : 2;
    frame.sequence = sent[0];
    frame.system = sent[1];
    frame.component = sent[2];
    frame.id = sent[3];
    if (!is_old) frame.id |= std::uint32_t{sent[4]} << 8 | std::uint32_t{sent[5]} << 16;
    frame.is_signed = (flags & kSigned) != 0;
    const auto extra = crcExtra(frame.id);
    if (!extra) return none(counts_.skipped_bytes);
    const std::size_t checked = header + bytes[1];
    const std::size_t length =
        checked + kChecksumBytes + (frame.is_signed ? kSignatureBytes : std::size_t{0});
    if (size < length) {
        counts_.skipped_bytes += incomplete;
        return incomplete;
    }
    const std::uint16_t crc = checksum(&*extra, 1, checksum(bytes + 1, checked - 1));
    if (crc != (bytes[checked] | bytes[checked + 1] << 8)) {
        ++counts_.bad_checksum;
        return none(counts_.skipped_bytes);
    }
    if ((flags & ~kSigned) != 0) {
        ++counts_.incompatible;
        return length;
    }
    std::copy(bytes + header, bytes + checked, frame.payload.begin());
    ++counts_.messages;
    counts_.version_1 += is_old ? 1 : 0;
    counts_.is_signed += frame.is_signed ? 1 : 0;
    countLost(frame);
    take(frame);
    return length;
}

void Parser::read(bool is_at_end, const Take& take) {
    std::size_t at = 0;
    while (at < waiting_.size()) {
        const std::size_t done = takeOne(at, is_at_end, take);
        if (done == 0) break;
        at += done;
    }
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(at));
}

void Parser::add(const std::uint8_t* bytes, std::size_t size, const Take& take) {
    waiting_.insert(waiting_.end(), bytes, bytes + size);
    read(false, take);
}

void Parser::end(const Take& take) { read(true, take); }

}  // namespace hagen::mavlink
