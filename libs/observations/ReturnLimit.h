#pragma once
#include <hagen/range_image/MostReturns.h>

#include <stdexcept>
#include <string>

namespace hagen::observations {

/// Throws std::runtime_error if an observation has more returns than a scan may have. Call it
/// before they are read, which takes memory.
inline void checkReturns(std::size_t returns) {
    if (returns <= kMostReturns) return;
    throw std::runtime_error("it has up to " + std::to_string(returns) +
                             " returns, more than the " + std::to_string(kMostReturns) +
                             " that a scan may have");
}

}  // namespace hagen::observations
