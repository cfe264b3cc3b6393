#include <hagen/avoidance/Distance.h>

#include "avoidance/flights/Words.h"

namespace hagen::avoidance {

ModelDistance distanceFrom(const std::string& name) {
    try {
        return wordFrom<ModelDistance>(name, avoidance::kModelDistances);
    } catch (const std::runtime_error& e) {
        throw std::invalid_argument(std::string("distance: ") + e.what());
    }
}

}  // namespace hagen::avoidance
