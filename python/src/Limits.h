#pragma once
#include <pybind11/pybind11.h>

#include <stdexcept>
#include <string>

namespace hagen::python {

/// Throws std::invalid_argument (ValueError in Python) unless `value` is between `min` and `max`;
/// throws for NaN. Requires the GIL.
inline void checkLimits(const std::string& what, double value, double min, double max) {
    if (value >= min && value <= max) return;
    const auto text = [](double number) {
        return pybind11::str(pybind11::float_(number)).cast<std::string>();
    };
    throw std::invalid_argument(what + ": " + text(value) + " is not between " + text(min) +
                                " and " + text(max));
}

}  // namespace hagen::python
