// Manual pages and shell completions, compared with --help.
#include <gmock/gmock.h>
#include <regex>

#include "support/Program.h"

namespace hagen {
namespace {

using testing::HasSubstr;

class Manual : public testing::TestWithParam<const char*> {};

TEST_P(Manual, ListsEveryFlag) {
    const std::filesystem::path program = GetParam(), share = HAGEN_BUILT_SHARE;
    const std::string name = program.filename().string();
    const std::string page = std::regex_replace(test::readFile(share / "man/man1" / (name + ".1")),
                                                std::regex(R"(\\-)"), "-");
    EXPECT_THAT(page, HasSubstr(".SH NAME\n" + name + " "));
    const std::string help = test::run(program.string(), {"--help"}).out;
    const std::regex flag("\n  (?:-[A-Za-z],)?(--[-a-z0-9]+)");
    for (std::sregex_iterator found(help.begin(), help.end(), flag), end; found != end; ++found) {
        EXPECT_THAT(page, HasSubstr((*found)[1].str()));
    }
    EXPECT_THAT(test::readFile(share / "bash-completion/completions" / name), HasSubstr(name));
    EXPECT_THAT(test::readFile(share / "zsh/site-functions" / ("_" + name)), HasSubstr(name));
}

INSTANTIATE_TEST_SUITE_P(Programs, Manual,
                         testing::Values(HAGEN_LIVE_SEGMENT, HAGEN_RAWLOG_SEGMENT,
                                         HAGEN_RAWLOG_SIMULATE, HAGEN_SEGMENTATION_EVALUATE,
                                         HAGEN_OCTOMAP_COMPARE));

}  // namespace
}  // namespace hagen
