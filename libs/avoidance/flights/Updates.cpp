#include <hagen/avoidance/Updates.h>

#include "avoidance/flights/Words.h"

namespace hagen::avoidance {

std::string nameOf(Updates updates) { return kUpdates[static_cast<std::size_t>(updates)]; }

Updates updatesFrom(const std::string& name) {
    try {
        return wordFrom<Updates>(name, kUpdates);
    } catch (const std::runtime_error& e) {
        throw std::invalid_argument(std::string("updates: ") + e.what());
    }
}

}  // namespace hagen::avoidance
