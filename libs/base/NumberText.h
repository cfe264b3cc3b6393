#pragma once
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace hagen::base {

/// Returns the shortest text that converts back to the same number, independent of the locale.
std::string shortestText(double value);
std::string shortestText(float value);

/// Returns the number with this many decimals, independent of the locale, and without a minus sign
/// if all digits are zero.
std::string fixedText(double value, int decimals);

/// Such as "1 packet", "3 packets". `many`: the plural, by default with an s.
std::string counted(std::size_t number, const std::string& one, const std::string& many = "");

/// Formats a share from 0 to 1 as "99.9 %". Rounds down, so that 100.0 % means all.
std::string percentText(float share);

/// Parses the entire text as a number, independent of the locale; nullopt for anything else.
template <class Number>
std::optional<Number> numberFrom(std::string_view text) {
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || rest != end || text.empty()) return std::nullopt;
    return value;
}

/// Parses two numbers around a separator, such as "12-34"; nullopt for anything else.
template <class Number>
std::optional<std::pair<Number, Number>> numbersFrom(std::string_view text, char separator) {
    const std::size_t at = text.find(separator);
    if (at == std::string_view::npos) return std::nullopt;
    const auto first = numberFrom<Number>(text.substr(0, at));
    const auto second = numberFrom<Number>(text.substr(at + 1));
    if (!first || !second) return std::nullopt;
    return std::pair{*first, *second};
}

}  // namespace hagen::base
