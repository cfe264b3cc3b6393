#pragma once
#include <array>
#include <locale>
#include <sstream>

namespace hagen::pictures {

/// Colour-blind safe palette (Okabe and Ito), indexed by obstacle number; the nearest obstacle has
/// the first colour. ROU and empty pixels are pale in comparison.
inline constexpr std::array<const char*, 6> kRoiColours{"#D55E00", "#0072B2", "#009E73",
                                                        "#CC79A7", "#E69F00", "#7A1F5C"};
inline constexpr const char* kRou = "#A9BCCB";
inline constexpr const char* kEmpty = "#E9E9E9";
inline constexpr const char* kInk = "#333333";

/// Returns a stream whose numbers are independent of the program's locale.
inline std::ostringstream plainText() {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(5);
    return text;
}

}  // namespace hagen::pictures
