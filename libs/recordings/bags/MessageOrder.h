#pragma once
#include "recordings/bags/BagFile.h"

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <vector>

namespace hagen::recordings {

/// Puts messages that are stored out of order, such as topic by topic, into the order of their
/// recording times, by holding up to kMaxHeldBytes of them. Messages stored even later keep their
/// place.
class MessageOrder {
 public:
    static constexpr std::size_t kMaxHeldBytes = 256 << 20;

    /// `is_held`: whether the messages of a topic (its index) are returned at all.
    MessageOrder(BagFile& bag, std::function<bool(const BagMessage&)> is_held)
        : bag_(bag), is_held_(std::move(is_held)) {}

    /// Like BagFile::next(). Throws the bag's errors after the messages before them.
    bool next(BagMessage& message);
    /// Number of messages that were returned too late.
    std::size_t late() const { return late_; }

 private:
    void fill();

    BagFile& bag_;
    std::function<bool(const BagMessage&)> is_held_;
    struct Held {
        std::size_t topic;
        std::vector<std::uint8_t> bytes;
    };
    std::multimap<std::int64_t, Held> held_;  ///< by time; equal times keep their order
    Held latest_;                             ///< the message returned last
    std::size_t held_bytes_ = 0, late_ = 0;
    std::int64_t latest_ns_ = INT64_MIN;
    bool is_at_end_ = false;
    std::exception_ptr error_;
};

}  // namespace hagen::recordings
