#include "base/OutputSet.h"
#include <gmock/gmock.h>
#include "base/WriteFile.h"

#include "support/Program.h"

namespace hagen::base {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

class OutputSetTest : public testing::Test {
 protected:
    OutputSetTest() {
        for (OutputPath* const output : {&first_, &second_, &third_}) set_.add(*output);
    }
    void write(const OutputPath& output) {
        set_.write(output, [&] { writeText("new", output.temporary(), output.path()); });
    }

    test::TemporaryFolder folder_;
    OutputPath first_{folder_ / "a", kFile, false}, second_{folder_ / "b", kFile, false},
        third_{folder_ / "c", kFile, false};
    OutputSet set_;
};

TEST_F(OutputSetTest, FailedOutputDoesNotAffectOthers) {
    write(first_);
    set_.write(second_, [] { throw std::runtime_error("no picture"); });
    set_.write(second_, [&] { FAIL() << "the output has failed"; });
    set_.write(third_, [&] { throw std::runtime_error(third_.temporary().string() + "/x: full"); });
    EXPECT_EQ(test::messageOf([&] { set_.commit(); }),
              second_.path().string() + ": no picture; " + third_.path().string() + "/x: full");
    EXPECT_EQ(test::readFile(first_.path()), "new");
    EXPECT_FALSE(fs::exists(second_.path()) || fs::exists(third_.path()));
}

TEST_F(OutputSetTest, ReportsWhenAllHaveFailed) {
    for (const OutputPath* const output : {&first_, &second_, &third_}) {
        EXPECT_FALSE(set_.areAllGivenUp());
        set_.write(*output, [] { throw std::runtime_error("no"); });
    }
    EXPECT_TRUE(set_.areAllGivenUp());
    EXPECT_THAT(set_.failures(), HasSubstr(second_.path().string() + ": no; "));
}

TEST_F(OutputSetTest, TakenNameDoesNotAffectOthers) {
    for (const OutputPath* const output : {&first_, &second_, &third_}) write(*output);
    folder_.write("a", "theirs");
    EXPECT_THAT(test::messageOf([&] { set_.commit(); }),
                AllOf(HasSubstr("a exists"), HasSubstr("this run's output was saved as"),
                      Not(HasSubstr(second_.path().string()))));
    EXPECT_EQ(test::readFile(folder_ / "a"), "theirs");
    EXPECT_EQ(test::readFile(folder_ / "a.partial"), "new");
    EXPECT_EQ(test::readFile(folder_ / "b"), "new");
    EXPECT_EQ(test::readFile(folder_ / "c"), "new");
}

TEST_F(OutputSetTest, RejectsUnknownOutput) {
    const OutputPath other(folder_ / "x", kFile, false);
    EXPECT_THROW(set_.write(other, [] {}), std::logic_error);
}

}  // namespace
}  // namespace hagen::base
