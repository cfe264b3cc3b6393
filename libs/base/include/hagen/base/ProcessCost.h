#pragma once
#include <sys/types.h>

#include <chrono>
#include <optional>

namespace hagen::base {

/// CPU time used by this thread.
std::chrono::nanoseconds threadCpuTime();
double threadCpuTime_ms();

/// CPU time used by a process, all threads together; none if there is no such process.
std::optional<std::chrono::nanoseconds> cpuTimeOf(pid_t process);

/// Heap memory in use by this process, all threads together [bytes].
double heapBytes();

}  // namespace hagen::base
