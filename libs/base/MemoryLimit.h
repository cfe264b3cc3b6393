#pragma once
#include <cstdint>
#include <string>

namespace hagen::base {

/// Memory of this machine [bytes].
std::uint64_t machineBytes();

/// Limits the memory of this process, without mapped files: further allocations throw
/// std::bad_alloc. Without effect under the address and thread sanitizers.
void limitMemory(std::uint64_t bytes);

/// "out of memory", with the limit if there is one.
std::string outOfMemory();

}  // namespace hagen::base
