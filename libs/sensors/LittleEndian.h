#pragma once
#include <cstddef>
#include <cstdint>

namespace hagen::sensors {

/// Reads a little-endian number at an arbitrary address.
template <class Number>
Number little(const std::uint8_t* at) {
    Number value = 0;
    for (std::size_t i = 0; i < sizeof value; ++i) {
        value = static_cast<Number>(value | static_cast<Number>(Number{at[i]} << (8 * i)));
    }
    return value;
}

}  // namespace hagen::sensors
