#include <hagen/trials/Updates.h>

#include "Words.h"

namespace hagen::trials {

std::string nameOf(Updates updates) { return kUpdates[static_cast<std::size_t>(updates)]; }

Updates updatesFrom(const std::string& name) {
    try {
        return wordFrom<Updates>(name, kUpdates);
    } catch (const std::runtime_error& e) {
        throw std::invalid_argument(std::string("updates: ") + e.what());
    }
}

}  // namespace hagen::trials
