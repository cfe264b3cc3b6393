#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/base/CommandLine.h>

#include <string>
#include <vector>

namespace hagen::base {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Ran {
    int exit_code;
    std::string out, err;
};

/// Runs a program with -i, with -c, which may be repeated, and with -q, which has no value.
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
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int exit_code =
        program.run(static_cast<int>(words.size()), argv.data(), [] { return kDone; });
    return {exit_code, testing::internal::GetCapturedStdout(),
            testing::internal::GetCapturedStderr()};
}

TEST(CommandLine, AValueWithoutAFlagGetsAHintIfOneIsKnown) {
    EXPECT_EQ(runWith({"-i", "log", "-q"}).exit_code, kDone);

    const Ran forgotten = runWith({"log", "-q"});
    EXPECT_EQ(forgotten.exit_code, kWrongUsage);
    EXPECT_THAT(forgotten.err, HasSubstr("use -i log"));
    EXPECT_THAT(runWith({"-q", "log"}).err, HasSubstr("use -i log"));

    // It may well be the value of the flag that is not known.
    const Ran unknown = runWith({"--colour", "red"});
    EXPECT_EQ(unknown.exit_code, kWrongUsage);
    EXPECT_THAT(unknown.err, HasSubstr("--colour"));
    EXPECT_THAT(unknown.err, Not(HasSubstr("use -i")));

    EXPECT_THAT(runWith({"-i", "log", "other"}).err, Not(HasSubstr("use -i")));
    EXPECT_THAT(runWith({"-c", "one", "two"}).err,
                HasSubstr("to name several, repeat the flag: -c one -c two"));
}

TEST(CommandLine, TextsMayNotBeEmpty) {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"-i", ""}, {"--input", ""}, {"-c", "a", "-c", ""}}) {
        const Ran ran = runWith(words);
        EXPECT_EQ(ran.exit_code, kWrongUsage) << words[0];
        EXPECT_THAT(ran.err, HasSubstr("must not be empty"));
    }
}

TEST(CommandLine, LimitsOfMemoryAreChecked) {
    EXPECT_EQ(runWith({"--memory-limit", "0.01"}).exit_code, kWrongUsage);
    EXPECT_EQ(runWith({"--memory-limit", "many"}).exit_code, kWrongUsage);
}

}  // namespace
}  // namespace hagen::base
