#include "scan/InstructionSets.h"
#include <gmock/gmock.h>

#include <cctype>
#include <cstdlib>

#include "support/InstructionSets.h"
#include "support/Program.h"

namespace hagen {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> visited() {
    std::vector<std::string> names;
    forEachInstructionSet([&](const std::string& name) { names.push_back(name); });
    return names;
}

TEST(InstructionSets, OmitSetsAboveLimit) {
    const auto all = instructionSets();
    ASSERT_FALSE(all.empty());
    for (std::size_t best = 0; best < all.size(); ++best) {
        limitInstructionSets(all[best]);
        EXPECT_EQ(
            instructionSets(),
            std::vector<std::string>(all.begin() + static_cast<std::ptrdiff_t>(best), all.end()));
        EXPECT_EQ(visited().size(), all.size() - best);
    }
    limitInstructionSets("");
    EXPECT_EQ(instructionSets(), all);
}

TEST(InstructionSets, IgnoreCaseAndAcceptScalarNames) {
    const auto all = instructionSets();
    std::string upper = all.front();
    for (char& c : upper) c = static_cast<char>(std::toupper(c));
    limitInstructionSets(upper);
    EXPECT_EQ(instructionSets(), all);
    if (all.back() == "emu128" || all.back() == "scalar") {
        for (const char* const plain : {"scalar", "emu128"}) {
            limitInstructionSets(plain);
            EXPECT_THAT(instructionSets(), ElementsAre(all.back()));
        }
    }
    limitInstructionSets("");
}

TEST(InstructionSets, RejectUnknownNames) {
    const auto all = instructionSets();
    for (const std::string& name : all) {
        EXPECT_THAT([] { limitInstructionSets("mmx"); },
                    testing::ThrowsMessage<std::invalid_argument>(
                        testing::AllOf(HasSubstr("'mmx'"), HasSubstr(name))));
    }
    EXPECT_EQ(instructionSets(), all);
}

/// The next test runs this in a separate process.
TEST(InstructionSets, DISABLED_LimitMatchesEnvironment) {
    const char* const wanted = std::getenv("HAGEN_SIMD");
    ASSERT_NE(wanted, nullptr);
    EXPECT_EQ(instructionSets().front(), wanted);
}

TEST(InstructionSets, FollowEnvironmentVariable) {
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    const auto start = [&](const std::string& name) {
        return test::run("/usr/bin/env",
                         {"HAGEN_SIMD=" + name, self, "--gtest_also_run_disabled_tests",
                          "--gtest_filter=*DISABLED_LimitMatchesEnvironment"});
    };
    for (const std::string& name : instructionSets()) {
        const test::Outcome outcome = start(name);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
        EXPECT_EQ(outcome.err, "");
    }
    const test::Outcome unknown = start("mmx");
    EXPECT_EQ(unknown.exit_code, 1);  // must not fall back to the first set
    EXPECT_THAT(unknown.err,
                HasSubstr("HAGEN_SIMD has no effect: 'mmx' is not an instruction set"));
}

}  // namespace
}  // namespace hagen
