#include "base/ProcessCost.h"
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#include <thread>
#include <vector>

namespace hagen::base {
namespace {

void useCpu_ms(double duration_ms) {
    const double start_ms = threadCpuTime_ms();
    while (threadCpuTime_ms() < start_ms + duration_ms) {
    }
}

TEST(ProcessCost, CountsThisThreadOnly) {
    const double start_ms = threadCpuTime_ms();
    std::thread(useCpu_ms, 20).join();
    EXPECT_LT(threadCpuTime_ms() - start_ms, 20);
}

TEST(ProcessCost, WaitingProcessUsesNoCpuTime) {
    int pipe[2];
    ASSERT_EQ(::pipe(pipe), 0);
    const pid_t child = fork();
    if (child == 0) {
        useCpu_ms(20);
        [[maybe_unused]] const auto sent = write(pipe[1], "x", 1);
        for (;;) pause();
    }
    char sent = 0;
    ASSERT_EQ(read(pipe[0], &sent, 1), 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // the child starts waiting
    const auto used = cpuTimeOf(child);
    EXPECT_GE(used, std::chrono::milliseconds(20));
    EXPECT_EQ(cpuTimeOf(child), used);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_FALSE(cpuTimeOf(child));
    for (const int end : pipe) close(end);
}

TEST(ProcessCost, HeapGrowsByAllocatedBytes) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer's heap does not report its size";
#endif
    constexpr std::size_t kBytes = 10'000'000;
    const double before = heapBytes();
    const std::vector<char> block(kBytes);
    EXPECT_NEAR(heapBytes() - before, kBytes, 100'000);
}

}  // namespace
}  // namespace hagen::base
