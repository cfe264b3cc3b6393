#pragma once
#include <cstddef>
#include <stdexcept>
#include <string>

namespace hagen {

/// Maximum number of returns in a scan, about 60 times that of the largest LiDARs, so that a map of
/// many scans is not mistaken for a scan. checkLocated() and the filter reject larger scans.
constexpr std::size_t kMaxReturns = 16'777'216;

/// Throws std::runtime_error if an observation exceeds kMaxReturns. Call it before reading the
/// returns into memory.
inline void checkReturns(std::size_t returns) {
    if (returns <= kMaxReturns) return;
    throw std::runtime_error("it has up to " + std::to_string(returns) +
                             " returns; a scan may have at most " + std::to_string(kMaxReturns));
}

}  // namespace hagen
