#include <gtest/gtest.h>
#include <hagen/base/ProcessCost.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#include <memory>
#include <thread>
#include <vector>

namespace hagen::base {
namespace {

TEST(ProcessCost, CountsThisThreadOnly) {
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

TEST(ProcessCost, WaitingProcessUsesNoCpuTime) {
    int pipe[2];
    ASSERT_EQ(::pipe(pipe), 0);
    const pid_t child = fork();
    if (child == 0) {
        const double start_ms = threadCpuTime_ms();
        while (threadCpuTime_ms() < start_ms + 20) {
        }
        [[maybe_unused]] const auto sent = write(pipe[1], "x", 1);
        for (;;) pause();
    }
    char sent = 0;
    ASSERT_EQ(read(pipe[0], &sent, 1), 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // until it waits
    const auto used = cpuTimeOf(child);
    EXPECT_GE(used, std::chrono::milliseconds(20));
    EXPECT_EQ(cpuTimeOf(child), used);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_FALSE(cpuTimeOf(child));
    close(pipe[0]);
    close(pipe[1]);
}

TEST(ProcessCost, HeapGrowsByAllocatedBytes) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer's heap does not report its size";
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
