#pragma once
#include <cstddef>
#include <cstdint>

namespace hagen {

/// The parts of Extraction.cpp shared by all instruction sets. Labels are stored as numbers.
constexpr std::size_t kReturnsPerWord = 64;

struct ExtractionInput {
    const float* range_m;
    const std::int32_t* pixel;
    const std::uint8_t* own_label;       ///< null if no return has its own label
    const std::uint8_t* label_of_pixel;  ///< index -1 is for no pixel; has three spare bytes
    float zone_m;
};

struct ExtractionOutput {
    std::uint8_t* label;
    std::uint32_t *roi, *rou, *unclassified;  ///< ends of the lists; writes may overrun by one word
};

}  // namespace hagen
