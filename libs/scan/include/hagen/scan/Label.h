#pragma once
#include <cstdint>

namespace hagen {

/// The filter's label of a return, with its number in label files.
enum class Label : std::uint8_t {
    Unclassified = 0,  ///< a return without range
    Rou = 1,           ///< region of uninterest: ground, far returns
    Roi = 2            ///< region of interest: a near obstacle
};

}  // namespace hagen
