#pragma once
#include <cstdint>
#include <string>

namespace hagen::base {

/// Memory of this machine [bytes].
std::uint64_t machineBytes();

/// Limits the memory of this process, not counting mapped files: allocations beyond the limit throw
/// std::bad_alloc. No effect under the address and thread sanitizers.
void limitMemory(std::uint64_t bytes);

/// "out of memory", with the limit if one is set.
std::string outOfMemory();

}  // namespace hagen::base
