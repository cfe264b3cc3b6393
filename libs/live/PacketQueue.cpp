#include <hagen/live/PacketQueue.h>

#include <utility>

namespace hagen::live {

double steadyNow_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

PacketQueue::PacketQueue(std::size_t max) : ring_(max) {}

void PacketQueue::put(Packet& packet) {
    ring_[(first_ + size_) % ring_.size()] = std::move(packet);
    ++size_;
    packet.bytes.clear();
    if (spare_.empty()) return;
    packet.bytes = std::move(spare_.back());
    spare_.pop_back();
}

bool PacketQueue::push(Packet& packet) {
    {
        const std::lock_guard lock(mutex_);
        if (size_ == ring_.size() || is_closed_) return false;
        put(packet);
    }
    has_packet_.notify_one();
    return true;
}

bool PacketQueue::pushOrWait(Packet& packet) {
    {
        std::unique_lock lock(mutex_);
        has_place_.wait(lock, [&] { return size_ < ring_.size() || is_closed_; });
        if (is_closed_) return false;
        put(packet);
    }
    has_packet_.notify_one();
    return true;
}

void PacketQueue::close() {
    {
        const std::lock_guard lock(mutex_);
        is_closed_ = true;
    }
    has_packet_.notify_all();
    has_place_.notify_all();
}

PacketQueue::Popped PacketQueue::pop(Packet& packet, std::chrono::microseconds longest) {
    {
        std::unique_lock lock(mutex_);
        has_packet_.wait_for(lock, longest, [&] { return size_ > 0 || is_closed_; });
        if (size_ == 0) return is_closed_ ? Popped::Closed : Popped::Nothing;
        spare_.push_back(std::move(packet.bytes));
        packet = std::move(ring_[first_]);
        first_ = (first_ + 1) % ring_.size();
        --size_;
    }
    has_place_.notify_one();
    return Popped::Packet;
}

std::size_t PacketQueue::size() const {
    const std::lock_guard lock(mutex_);
    return size_;
}

}  // namespace hagen::live
