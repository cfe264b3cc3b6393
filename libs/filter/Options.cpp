#include <hagen/filter/Options.h>
#include <sstream>
#include <stdexcept>
#include <string>
#include <variant>
#include "filter/OptionKeys.h"

namespace hagen {
namespace {

/// Rounds a limit to the option's type, like the settings: 0.01f is below 0.01.
double asOption(double limit, const OptionKey& key) {
    const bool is_float = std::holds_alternative<float Options::*>(key.field);
    return is_float ? static_cast<double>(static_cast<float>(limit)) : limit;
}

}  // namespace

void checkOptions(const Options& options, int beams) {
    for (const OptionKey& key : optionKeys()) {
        const double value =
            std::visit([&](auto field) { return static_cast<double>(options.*field); }, key.field);
        if (!(value >= asOption(key.min, key) && value <= asOption(key.max, key))) {  // or NaN
            std::ostringstream message;
            message << key.name << " is " << value << ", but must lie between " << key.min
                    << " and " << key.max;
            throw std::invalid_argument(message.str());
        }
    }
    if (options.principal_components > options.window_size) {
        throw std::invalid_argument(
            "principal_components (" + std::to_string(options.principal_components) +
            ") exceeds window_size (" + std::to_string(options.window_size) +
            "): there are no more components than rows in the window");
    }
    if (options.window_size >= beams) {
        throw std::invalid_argument("window_size (" + std::to_string(options.window_size) +
                                    ") exceeds the " + std::to_string(beams - 1) +
                                    " range angles in a column of a sensor with " +
                                    std::to_string(beams) + " beams: nothing would be smoothed");
    }
}

}  // namespace hagen
