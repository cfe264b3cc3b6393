#include "base/MemoryLimit.h"
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>

namespace hagen::base {
namespace {

/// A worker gets the limit of the program that starts it. In a process of its own.
TEST(MemoryLimit, IsNeverRaised) {
    const auto limitTwice = [] {
        constexpr rlim_t kLow = 1 << 28, kHigh = 1 << 30;
        rlimit limit{};
        limitMemory(kLow);
        limitMemory(kHigh);
        getrlimit(RLIMIT_DATA, &limit);
        // Sanitizers need memory of their own: with them there is no limit.
        std::_Exit(limit.rlim_cur == kLow || limit.rlim_cur > kHigh ? 7 : 1);
    };
    EXPECT_EXIT(limitTwice(), testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace hagen::base
