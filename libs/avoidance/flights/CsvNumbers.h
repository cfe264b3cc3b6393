#pragma once
#include <hagen/base/NumberText.h>
#include <cmath>
#include <stdexcept>
#include <string>

namespace hagen::avoidance {

/// A field of a CSV file: the number with this many decimals; NaN is an empty field.
inline std::string measureText(double value, int decimals) {
    return std::isnan(value) ? "" : base::fixedText(value, decimals);
}

/// Throws std::runtime_error for a text that is not a number from start to end.
template <class Number>
Number parsedNumber(const std::string& text) {
    if (const auto value = base::numberFrom<Number>(text)) return *value;
    throw std::runtime_error("\"" + text + "\" is not a number");
}

}  // namespace hagen::avoidance
