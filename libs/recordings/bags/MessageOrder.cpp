#include "recordings/bags/MessageOrder.h"

#include <algorithm>
#include <utility>

namespace hagen::recordings {

void MessageOrder::fill() {
    BagMessage message;
    try {
        while (!is_at_end_ && held_bytes_ < kMaxHeldBytes) {
            is_at_end_ = !bag_.next(message);
            if (is_at_end_ || !is_held_(message)) continue;
            held_bytes_ += message.size;
            held_.emplace(message.time_ns,
                          Held{message.topic, {message.bytes, message.bytes + message.size}});
        }
    } catch (const BrokenRecording&) {
        error_ = std::current_exception();
        is_at_end_ = true;
    }
}

bool MessageOrder::next(BagMessage& message) {
    fill();
    if (held_.empty()) {
        if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
        return false;
    }
    const auto first = held_.begin();
    late_ += first->first < latest_ns_;
    latest_ns_ = std::max(latest_ns_, first->first);
    latest_ = std::move(first->second);
    message = {latest_.topic, first->first, latest_.bytes.data(), latest_.bytes.size()};
    held_bytes_ -= latest_.bytes.size();
    held_.erase(first);
    return true;
}

}  // namespace hagen::recordings
