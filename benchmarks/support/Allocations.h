#pragma once
#include <cstddef>

namespace hagen {

/// How often this program asked for memory on the heap so far, all threads together: by malloc()
/// and its kin, which operator new and Eigen end in. Always 0 where a sanitizer has taken malloc()
/// for itself; see countsAllocations().
std::size_t allocations();
bool countsAllocations();

}  // namespace hagen
