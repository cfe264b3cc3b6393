#pragma once
#include <array>
#include <cstdint>

namespace hagen {

/// For each byte: which bits are set, from the lowest up (then zeros), and how many. Used to move
/// chosen lanes of a vector to its front: Highway 1.0's own Compress() copies its table to the
/// stack on every call when GCC 12 compiles it for AVX2.
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
