#include <gtest/gtest.h>
#include <hagen/base/ProcessCost.h>
#include <memory>
#include <thread>
#include <vector>

namespace hagen::base {
namespace {

TEST(ProcessCost, CpuTimeIsThatOfThisThreadAlone) {
    const double before_ms = threadCpuTime_ms();
    std::thread other([] {
        const double start_ms = threadCpuTime_ms();
        while (threadCpuTime_ms() < start_ms + 20) {
        }
    });
    other.join();
    EXPECT_LT(threadCpuTime_ms() - before_ms, 20);
    const auto start = threadCpuTime();
    while (threadCpuTime() == start) {
    }
    EXPECT_GT(threadCpuTime(), start);
}

TEST(ProcessCost, TheHeapGrowsByWhatIsAllocated) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer's heap does not tell its size";
#endif
    constexpr std::size_t kBytes = 10'000'000;
    const double before = heapBytes();
    auto block = std::make_unique<std::vector<char>>(kBytes);
    EXPECT_NEAR(heapBytes() - before, kBytes, 100'000);
    block.reset();
    EXPECT_NEAR(heapBytes(), before, 100'000);
}

}  // namespace
}  // namespace hagen::base
