#pragma once
#include "live/mavlink/Frame.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace hagen::mavlink {

/// Finds the MAVLink 2 messages in a stream of bytes, with any bytes between them. After a wrong
/// checksum or an unknown number, reading resumes behind the first byte, so that no following
/// message is lost. Invalid bytes never cause an exception.
class Parser {
 public:
    struct Counts {
        std::size_t messages = 0;
        std::size_t is_signed = 0;      ///< of these; signatures are not checked
        std::size_t lost = 0;           ///< missing by the sequence of their component
        std::size_t bad_checksum = 0;   ///< began like a message
        std::size_t incompatible = 0;   ///< skipped: an unknown format
        std::size_t skipped_bytes = 0;  ///< of no message, such as MAVLink 1
    };
    using Take = std::function<void(const Frame&)>;

    /// Adds bytes of a stream; calls `take` for each message that they complete.
    void add(const std::uint8_t* bytes, std::size_t size, const Take& take);
    /// What was added ends here, as a datagram does: a message that began is not completed.
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
