#pragma once
#include "live/mavlink/Frame.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace hagen::mavlink {

/// Finds the MAVLink 2 messages in a stream of other bytes. A frame with a wrong
/// checksum or an unknown number is not a message: reading resumes after its first byte, so that a
/// message that follows is not lost. Never throws because of what the bytes are.
class Parser {
 public:
    struct Counts {
        std::size_t messages = 0;
        std::size_t is_signed = 0;      ///< of these; signatures are not checked
        std::size_t lost = 0;           ///< missing by the sequence of their component
        std::size_t bad_checksum = 0;   ///< began like a message
        std::size_t incompatible = 0;   ///< skipped: unknown incompatibility flags
        std::size_t skipped_bytes = 0;  ///< of no message, such as MAVLink 1
    };
    using Take = std::function<void(const Frame&)>;

    /// Adds bytes of a stream; calls `take` for each message that they complete.
    void add(const std::uint8_t* bytes, std::size_t size, const Take& take);
    /// Ends the added bytes, as a datagram does: a partial message is not completed.
    void end(const Take& take);

    const Counts& counts() const { return counts_; }

 private:
    std::size_t takeOne(std::size_t at, bool is_at_end, const Take& take);
    void read(bool is_at_end, const Take& take);
    void countLost(const Frame& frame);

    std::vector<std::uint8_t> waiting_;
    std::map<std::pair<std::uint8_t, std::uint8_t>, std::uint8_t> sequences_;
    Counts counts_;
};

}  // namespace hagen::mavlink
