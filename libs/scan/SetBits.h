#pragma once
#include <array>
#include <cstdint>

namespace hagen {

/// For each byte: the indices of its set bits, lowest first (padded with zeros), and their number.
/// Used to move selected lanes to the front of a vector. Replaces Highway 1.0's Compress(), because
/// GCC 12 copies its table to the stack on every call for AVX2.
struct SetBits {
    std::array<std::array<std::uint8_t, 8>, 256> place{};
    std::array<std::uint8_t, 256> count{};

    constexpr SetBits() {
        for (unsigned byte = 0; byte < 256; ++byte) {
            for (std::uint8_t bit = 0; bit < 8; ++bit) {
                if ((byte >> bit & 1) != 0) place[byte][count[byte]++] = bit;
            }
        }
    }
};
inline constexpr SetBits kSetBits;

}  // namespace hagen
