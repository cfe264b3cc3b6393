#pragma once
#include <cstdint>
#include <string>

namespace hagen::base {

/// Memory of this machine [bytes].
std::uint64_t machineBytes();

/// Limits the memory of this process: beyond it, allocations throw std::bad_alloc instead of
/// bringing the machine to a halt. What is mapped from files does not count. Without effect under
/// the address and thread sanitizers, whose own memory exceeds any limit.
void limitMemory(std::uint64_t bytes);

/// "out of memory", and which limit there is, if any.
std::string outOfMemory();

}  // namespace hagen::base
