#pragma once
#include <cstddef>

namespace hagen {

/// Returns of a scan, at most: some 60 times those of the largest LiDARs. A map of many scans is no
/// scan. checkLocated(), and so the filter, refuses more.
constexpr std::size_t kMostReturns = 16'777'216;

}  // namespace hagen
