#pragma once
#include <cstddef>
#include <stdexcept>
#include <string>

namespace hagen {

/// Returns of a scan, at most: some 60 times those of the largest LiDARs. A map of many scans is no
/// scan. checkLocated(), and so the filter, refuses more.
constexpr std::size_t kMaxReturns = 16'777'216;

/// Throws std::runtime_error if an observation has more returns than a scan may have. Call it
/// before they are read, which takes memory.
inline void checkReturns(std::size_t returns) {
    if (returns <= kMaxReturns) return;
    throw std::runtime_error("it has up to " + std::to_string(returns) +
                             " returns, more than the " + std::to_string(kMaxReturns) +
                             " that a scan may have");
}

}  // namespace hagen
