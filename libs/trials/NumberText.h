#pragma once
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>

namespace hagen {

/// A number with this many decimals, '.' in every locale, and no minus sign before zeros alone.
/// NaN is an empty text.
inline std::string fixedText(double value, int decimals) {
    if (std::isnan(value)) return "";
    std::array<char, 400> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                   std::chars_format::fixed, decimals);
    const std::string written(text.data(), end.ptr);
    const bool is_zero = written.find_first_not_of("-0.") == std::string::npos;
    return is_zero && written[0] == '-' ? written.substr(1) : written;
}

/// The fewest digits that read back as the same number.
inline std::string shortText(double value) {
    std::array<char, 400> text;
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// Throws std::runtime_error for a text that is not a number from start to end.
template <class Number>
Number numberFrom(const std::string& text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || text.empty()) {
        throw std::runtime_error("\"" + text + "\" is no number");
    }
    return value;
}

}  // namespace hagen
