#pragma once
#include "base/TextStream.h"

#include <array>

namespace hagen::convert {

/// Colour-blind safe palette (Okabe and Ito), indexed by obstacle number; the nearest obstacle has
/// the first colour. ROU and empty pixels are pale.
inline constexpr std::array<const char*, 6> kRoiColours{"#D55E00", "#0072B2", "#009E73",
                                                        "#CC79A7", "#E69F00", "#7A1F5C"};
inline constexpr const char* kRou = "#A9BCCB";
inline constexpr const char* kEmpty = "#E9E9E9";
inline constexpr const char* kInk = "#333333";

/// A script or its data, with five-digit numbers.
class GnuplotStream : public base::TextStream {
 public:
    GnuplotStream() { precision(5); }
};

}  // namespace hagen::convert
