#include <hagen/base/ProcessCost.h>
#include <malloc.h>
#include <time.h>

namespace hagen::base {

std::chrono::nanoseconds threadCpuTime() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

double threadCpuTime_ms() {
    return std::chrono::duration<double, std::milli>(threadCpuTime()).count();
}

double heapBytes() {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

}  // namespace hagen::base
