#pragma once
#include <cstddef>

namespace hagen {

/// Number of heap allocations of this program so far, in all threads: malloc() and related
/// functions, which operator new and Eigen use. Always 0 if a sanitizer has replaced malloc(); see
/// countsAllocations().
std::size_t allocations();
bool countsAllocations();

}  // namespace hagen
