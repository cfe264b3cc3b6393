#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/base/CommandLine.h>

#include <sys/resource.h>

#include <cstddef>
#include <new>
#include <stdexcept>
#include <string>

namespace hagen::base {
namespace {

/// What guarded() prints on standard error; its exit code must be kFailed.
std::string messageOf(int (*program)(int, char**)) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(guarded(0, nullptr, program), kFailed);
    return testing::internal::GetCapturedStderr();
}

TEST(Guarded, PassesArgumentsAndTheExitCodeOn) {
    char name[] = "name";
    char* argv[] = {name, nullptr};
    const auto program = [](int argc, char** given) {
        return argc == 1 && std::string(given[0]) == "name" ? 7 : 8;
    };
    EXPECT_EQ(guarded(1, argv, program), 7);
}

TEST(Guarded, SaysWhatNobodyCaught) {
    EXPECT_THAT(messageOf([](int, char**) -> int { throw std::bad_alloc(); }),
                testing::EndsWith(": out of memory\n"));
    EXPECT_THAT(messageOf([](int, char**) -> int { throw std::runtime_error("the reason"); }),
                testing::EndsWith(": the reason\n"));
    EXPECT_THAT(messageOf([](int, char**) -> int { throw 1; }),
                testing::EndsWith(": ended by an unknown error\n"));
}

/// Where the shell gave little stack (ulimit -s), the program runs on a thread of its own.
TEST(Guarded, GivesRoomOnTheStack) {
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_STACK, &before), 0);
    const rlimit small{256 << 10, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_STACK, &small), 0);
    const int result = guarded(0, nullptr, [](int, char**) {
        volatile char room[4 << 20];
        for (std::size_t i = 0; i < sizeof room; i += 1024) room[i] = 1;
        return static_cast<int>(room[1024]);
    });
    EXPECT_EQ(setrlimit(RLIMIT_STACK, &before), 0);
    EXPECT_EQ(result, 1);
    EXPECT_THAT(messageOf([](int, char**) -> int { throw std::runtime_error("the reason"); }),
                testing::EndsWith(": the reason\n"));
}

}  // namespace
}  // namespace hagen::base
