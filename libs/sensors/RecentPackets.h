#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace hagen::sensors {

/// Detects duplicate packets, such as from a second network path, by the 64-bit keys of the packets
/// of the last 0.3 s. Packets of a repeated recording are not duplicates.
class RecentPackets {
 public:
    RecentPackets() : places_(kPlaces) {}

    bool has(std::uint64_t key, double now_s) const {
        for (const Packet& other : places_[key % kPlaces]) {
            if (other.key == key && now_s - other.time_s <= kRemembered_s) return true;
        }
        return false;
    }

    /// Replaces the oldest of the four packets in the slot.
    void add(std::uint64_t key, double now_s) {
        Place& place = places_[key % kPlaces];
        for (std::size_t i = place.size() - 1; i > 0; --i) place[i] = place[i - 1];
        place[0] = {key, now_s};
    }

 private:
    static constexpr double kRemembered_s = 0.3;
    static constexpr std::size_t kPlaces = 1021;  // a prime, because keys may have a pattern
    struct Packet {
        std::uint64_t key = 0;
        double time_s = -std::numeric_limits<double>::infinity();
    };
    using Place = std::array<Packet, 4>;

    std::vector<Place> places_;
};

}  // namespace hagen::sensors
