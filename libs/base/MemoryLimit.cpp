#include "base/MemoryLimit.h"
#include "base/NumberText.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>

namespace hagen::base {
namespace {

std::atomic<std::uint64_t> limit_bytes = 0;  // 0: no limit

}  // namespace

std::uint64_t machineBytes() {
    return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
           static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void limitMemory(std::uint64_t bytes) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    rlimit limit{};
    if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
    limit_bytes = bytes < limit.rlim_cur ? bytes : 0;  // 0 if a lower limit is already set
    limit.rlim_cur = std::min<rlim_t>(bytes, limit.rlim_cur);
    setrlimit(RLIMIT_DATA, &limit);
#else
    static_cast<void>(bytes);
#endif
}

std::string outOfMemory() {
    constexpr double kGb = 1e9;
    const auto limit_gb = static_cast<double>(limit_bytes.load()) / kGb;
    if (limit_gb <= 0) return "out of memory";
    return "out of memory (--memory-limit: " + shortestText(limit_gb) + " GB)";
}

}  // namespace hagen::base
