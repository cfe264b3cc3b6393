#include <gmock/gmock.h>
#include <sstream>

#include "support/Program.h"

namespace hagen {
namespace {

struct Command {
    std::string program;
    std::vector<std::string> words;
};

class Help : public testing::TestWithParam<Command> {};

TEST_P(Help, FitsIn80Columns) {
    auto words = GetParam().words;
    words.push_back("--help");
    const auto outcome = test::run(GetParam().program, words);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.out, testing::HasSubstr("Usage: "));
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(line.size(), 80u) << line;
        EXPECT_TRUE(line.empty() || line.back() != ' ') << line;
    }
}

INSTANTIATE_TEST_SUITE_P(Programs, Help,
                         testing::Values(Command{HAGEN_LIVE_SEGMENT, {}},
                                         Command{HAGEN_RAWLOG_SEGMENT, {}},
                                         Command{HAGEN_RAWLOG_SIMULATE, {}},
                                         Command{HAGEN_SEGMENTATION_EVALUATE, {}},
                                         Command{HAGEN_OCTOMAP_COMPARE, {}},
                                         Command{HAGEN_OCTOMAP_COMPARE, {"closedloop"}},
                                         Command{HAGEN_OCTOMAP_COMPARE, {"openloop"}},
                                         Command{HAGEN_OCTOMAP_COMPARE, {"replay"}},
                                         Command{HAGEN_OCTOMAP_COMPARE, {"calibrate"}}));

TEST(HelpText, ListsScenariosAndModels) {
    EXPECT_THAT(test::run(HAGEN_RAWLOG_SIMULATE, {"--help"}).out, testing::HasSubstr("orchard"));
    const std::string closedloop = test::run(HAGEN_OCTOMAP_COMPARE, {"closedloop", "--help"}).out;
    for (const char* word : {"u-trap", "W-RoI+motion", "R-Full-0.2", "D-Full"}) {
        EXPECT_THAT(closedloop, testing::HasSubstr(word));
    }
}

}  // namespace
}  // namespace hagen
