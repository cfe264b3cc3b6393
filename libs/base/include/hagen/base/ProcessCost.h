#pragma once
#include <chrono>

namespace hagen::base {

/// CPU time used by this thread.
std::chrono::nanoseconds threadCpuTime();
double threadCpuTime_ms();

/// Heap memory in use by this process, all threads together [bytes].
double heapBytes();

}  // namespace hagen::base
