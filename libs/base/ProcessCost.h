#pragma once
#include <sys/types.h>

#include <chrono>
#include <optional>

namespace hagen::base {

/// CPU time used by this thread.
std::chrono::nanoseconds threadCpuTime();
double threadCpuTime_ms();

/// CPU time of all threads of a process; nullopt if the process does not exist.
std::optional<std::chrono::nanoseconds> cpuTimeOf(pid_t process);

/// Heap memory in use by this process [bytes].
double heapBytes();

}  // namespace hagen::base
