#include <hagen/segmentation/Options.h>
#include <stdexcept>
#include <string>

namespace hagen {

void checkOptions(const Options& options, int beams) {
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
