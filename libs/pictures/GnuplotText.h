#pragma once
#include <array>
#include <locale>
#include <sstream>

namespace hagen::pictures {

/// Colours that the colour-blind tell apart (Okabe and Ito); an obstacle takes the one of its
/// number, the nearest the first. ROU and empty pixels are pale beside all of them.
inline constexpr std::array<const char*, 6> kRoiColours{"#D55E00", "#0072B2", "#009E73",
                                                        "#CC79A7", "#E69F00", "#7A1F5C"};
inline constexpr const char* kRou = "#A9BCCB";
inline constexpr const char* kEmpty = "#E9E9E9";
inline constexpr const char* kInk = "#333333";

/// A stream whose numbers read the same whatever locale the program has set.
inline std::ostringstream plainText() {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(5);
    return text;
}

}  // namespace hagen::pictures
