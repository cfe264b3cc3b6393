#pragma once
#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace hagen::base {

/// The shortest text that reads back as the same number, whatever the locale.
std::string shortestText(double value);
std::string shortestText(float value);

/// With this many decimals, '.' whatever the locale, and no minus sign before zeros alone.
std::string fixedText(double value, int decimals);

/// The number that the whole text is, whatever the locale; nothing where it is anything else.
template <class Number>
std::optional<Number> numberFrom(std::string_view text) {
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || rest != end || text.empty()) return std::nullopt;
    return value;
}

}  // namespace hagen::base
