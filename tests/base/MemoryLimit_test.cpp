#include "base/MemoryLimit.h"
#include <gtest/gtest.h>
#include <sys/resource.h>

namespace hagen::base {
namespace {

/// A worker inherits its parent's limit. Runs in a separate process.
TEST(MemoryLimit, IsNeverRaised) {
    const auto limitTwice = [] {
        constexpr rlim_t kLow = 1 << 28, kHigh = 1 << 30;
        rlimit limit{};
        limitMemory(kLow);
        limitMemory(kHigh);
        getrlimit(RLIMIT_DATA, &limit);
        // Sanitizers disable the limit, as they need extra memory.
        std::_Exit(limit.rlim_cur == kLow || limit.rlim_cur > kHigh ? 7 : 1);
    };
    EXPECT_EXIT(limitTwice(), testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace hagen::base
