#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/command_line/CommandLine.h>

#include <new>
#include <stdexcept>
#include <string>

namespace hagen::command_line {
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

}  // namespace
}  // namespace hagen::command_line
