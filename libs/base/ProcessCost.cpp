#include "base/ProcessCost.h"
#include <malloc.h>
#include <time.h>

namespace hagen::base {

namespace {

std::chrono::nanoseconds durationOf(const timespec& time) {
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace

std::chrono::nanoseconds threadCpuTime() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return durationOf(now);
}

std::optional<std::chrono::nanoseconds> cpuTimeOf(pid_t process) {
    clockid_t clock{};
    timespec used{};
    if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &used) != 0) {
        return std::nullopt;
    }
    return durationOf(used);
}

double threadCpuTime_ms() {
    return std::chrono::duration<double, std::milli>(threadCpuTime()).count();
}

double heapBytes() {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

}  // namespace hagen::base
