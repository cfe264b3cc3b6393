#include "base/command_line/CommandLine.h"
#include <gmock/gmock.h>

#include <new>

namespace hagen::base {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

struct Ran {
    int exit_code;
    std::string err;
};

/// Runs a program with the flags -i, -c (repeatable) and -q (without a value).
Ran runWith(std::vector<std::string> words) {
    words.insert(words.begin(), "program");
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    std::string input;
    std::vector<std::string> configs;
    bool is_quiet = false;
    Program program("program", "Does nothing.");
    program.option("-i,--input", input, "what to read");
    program.option("-c,--config", configs, "a file").once();
    program.flag("-q,--quiet", is_quiet, "print nothing");
    testing::internal::CaptureStderr();
    const int exit_code =
        program.run(static_cast<int>(words.size()), argv.data(), [] { return kDone; });
    return {exit_code, testing::internal::GetCapturedStderr()};
}

TEST(CommandLine, RejectsUnexpectedWords) {
    EXPECT_EQ(runWith({"-i", "log", "-q"}).exit_code, kDone);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"log", "-q"}, {"-c", "one", "log"}, {"--colour", "log"}}) {
        const Ran ran = runWith(words);
        EXPECT_EQ(ran.exit_code, kWrongUsage);
        EXPECT_THAT(ran.err, HasSubstr("not expected: "));
        EXPECT_THAT(ran.err, HasSubstr("log"));
    }
}

TEST(CommandLine, RejectsEmptyTexts) {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"-i", ""}, {"--input", ""}, {"-c", "a", "-c", ""}}) {
        const Ran ran = runWith(words);
        EXPECT_EQ(ran.exit_code, kWrongUsage) << words[0];
        EXPECT_THAT(ran.err, HasSubstr("must not be empty"));
    }
}

TEST(CommandLine, ChecksMemoryLimit) {
    EXPECT_EQ(runWith({"--memory-limit", "0.01"}).exit_code, kWrongUsage);
    EXPECT_EQ(runWith({"--memory-limit", "many"}).exit_code, kWrongUsage);
}

std::string guardedErrorOf(int (*program)(int, char**)) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(guarded(0, nullptr, program), kFailed);
    return testing::internal::GetCapturedStderr();
}

TEST(Guarded, ReturnsExitCode) {
    EXPECT_EQ(guarded(7, nullptr, [](int argc, char**) { return argc; }), 7);
}

TEST(Guarded, ReportsUncaughtErrors) {
    EXPECT_THAT(guardedErrorOf([](int, char**) -> int { throw std::bad_alloc(); }),
                EndsWith(": out of memory\n"));
    EXPECT_THAT(guardedErrorOf([](int, char**) -> int { throw std::runtime_error("reason"); }),
                EndsWith(": reason\n"));
    EXPECT_THAT(guardedErrorOf([](int, char**) -> int { throw 1; }), EndsWith("unknown error\n"));
}

}  // namespace
}  // namespace hagen::base
