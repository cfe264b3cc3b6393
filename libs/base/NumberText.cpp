#include "base/NumberText.h"
#include <array>
#include <cmath>

namespace hagen::base {
namespace {

constexpr std::size_t kMaxLength = 400;  // 1e308 has 309 digits before the decimal point

template <class Real, class... Format>
std::string textOf(Real value, Format... format) {
    std::array<char, kMaxLength> text;
    return {text.data(),
            std::to_chars(text.data(), text.data() + text.size(), value, format...).ptr};
}

}  // namespace

std::string shortestText(double value) { return textOf(value); }

std::string shortestText(float value) { return textOf(value); }

std::string fixedText(double value, int decimals) {
    const std::string text = textOf(value, std::chars_format::fixed, decimals);
    const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
    return is_zero && text[0] == '-' ? text.substr(1) : text;
}

std::string percentText(float share) {
    return fixedText(0.1 * std::floor(1000.0 * static_cast<double>(share)), 1) + " %";
}

std::string counted(std::size_t number, const std::string& one, const std::string& many) {
    return std::to_string(number) + " " + (number == 1 ? one : many.empty() ? one + "s" : many);
}

}  // namespace hagen::base
