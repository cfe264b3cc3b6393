#pragma once
#include <chrono>

namespace hagen::base {

/// CPU time that this thread has used.
std::chrono::nanoseconds threadCpuTime();
double threadCpuTime_ms();

/// What the heap of this process holds, all threads together [bytes].
double heapBytes();

}  // namespace hagen::base
