#pragma once
#include "live/mavlink/Frame.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace hagen::mavlink {

/// Finds MAVLink 1 and 2 messages in a byte stream. A frame with a wrong checksum or an unknown
/// message ID is skipped by one byte only, so that a message inside is not lost. Does not throw on
/// invalid input.
class Parser {
 public:
    struct Counts {
        std::size_t messages = 0;
        std::size_t version_1 = 0;      ///< messages of MAVLink 1
        std::size_t is_signed = 0;      ///< messages with a signature, which is not checked
        std::size_t lost = 0;           ///< messages missing from the components' sequences
        std::size_t bad_checksum = 0;   ///< frames with a wrong checksum
        std::size_t incompatible = 0;   ///< frames skipped because of unknown incompatibility flags
        std::size_t skipped_bytes = 0;  ///< bytes outside messages
    };
    using Take = std::function<void(const Frame&)>;

    /// Parses bytes of a stream; calls `take` for each completed message.
    void add(const std::uint8_t* bytes, std::size_t size, const Take& take);
    /// Discards a partial message, as at the end of a datagram.
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
