#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace hagen {

/// A sort key of a number >= 0 and its item; keys ascend as numbers descend.
inline std::uint64_t sinkingKey(float number, std::size_t item) {
    std::uint32_t bits;  // in the order of the numbers
    std::memcpy(&bits, &number, sizeof bits);
    return std::uint64_t{~bits} << 32 | item;
}

inline std::size_t itemOf(std::uint64_t key) { return static_cast<std::uint32_t>(key); }

/// Stable radix sort by the numbers, 8 bits at a time, in linear time. `swap` is a buffer.
inline void radixSort(std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& swap) {
    constexpr int kDigits = 4, kValues = 256;
    const auto digitOf = [](std::uint64_t key, int digit) { return key >> (32 + 8 * digit) & 255; };
    std::array<std::array<std::uint32_t, kValues>, kDigits> place{};
    for (const std::uint64_t key : keys) {
        for (int digit = 0; digit < kDigits; ++digit) ++place[digit][digitOf(key, digit)];
    }
    swap.resize(keys.size());
    for (int digit = 0; digit < kDigits; ++digit) {
        std::uint32_t next = 0;
        for (std::uint32_t& first : place[digit]) {
            const std::uint32_t count = first;
            first = next;
            next += count;
        }
        for (const std::uint64_t key : keys) swap[place[digit][digitOf(key, digit)]++] = key;
        keys.swap(swap);
    }
}

}  // namespace hagen
