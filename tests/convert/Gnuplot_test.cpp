#include "convert/pictures/Gnuplot.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/Program.h"

namespace hagen::convert {
namespace {

using testing::HasSubstr;

/// The SVG that gnuplot draws of this text.
std::string drawn(const std::string& text) {
    const test::TemporaryFolder folder;
    runGnuplot("set terminal svg\nset output 'text.svg'\nset label " + gnuplotString(text) +
                   " at 0,0 noenhanced\nplot [0:1][0:1] x\n",
               folder.path(), {"text.svg"});
    return test::readFile(folder / "text.svg");
}

TEST(Gnuplot, QuotesAnyText) {
    EXPECT_THAT(drawn("beta_deg=5, Peter's \\n `date` @x {a}"),
                HasSubstr("beta_deg=5, Peter's \\n `date` @x {a}"));
    EXPECT_THAT(drawn("one\nset output 'other.svg'"), HasSubstr("one set output 'other.svg'"));
}

TEST(Gnuplot, IgnoresUsersTerminal) {
    setenv("GNUTERM", "none such", 1);
    EXPECT_THAT(drawn("text"), HasSubstr("text"));
    unsetenv("GNUTERM");
}

TEST(Gnuplot, RejectsTruncatedSvg) {
    const test::TemporaryFolder folder;
    const std::string error = test::messageOf([&] {
        runGnuplot("set print 'half.svg'\nprint '<?xml version=\"1.0\"?><svg>'\n", folder.path(),
                   {"half.svg"});
    });
    EXPECT_THAT(error, HasSubstr("half.svg could not be written completely"));
}

}  // namespace
}  // namespace hagen::convert
