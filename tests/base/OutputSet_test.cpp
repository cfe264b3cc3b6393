#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/base/OutputSet.h>
#include <hagen/base/WriteFile.h>

#include <functional>
#include <new>
#include <stdexcept>
#include <vector>

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
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder_.path())) {
            names.push_back(entry.path().filename().string());
        }
        return names;
    }

    test::TemporaryFolder folder_;
    OutputPath first_{folder_ / "a", kFile, false}, second_{folder_ / "b", kFile, false},
        third_{folder_ / "c", kFile, false};
    OutputSet set_;
};

TEST_F(OutputSetTest, AllGetTheirNames) {
    for (const OutputPath* const output : {&first_, &second_, &third_}) write(*output);
    set_.commit();
    EXPECT_THAT(names(), testing::UnorderedElementsAre("a", "b", "c"));
}

TEST_F(OutputSetTest, OneThatCannotBeWrittenDoesNotCostTheOthers) {
    write(first_);
    set_.write(second_, [] { throw std::runtime_error("no picture"); });
    int calls = 0;
    set_.write(second_, [&] { ++calls; });
    set_.write(third_, [&] { throw std::runtime_error(third_.temporary().string() + "/x: full"); });
    EXPECT_EQ(calls, 0);
    const std::string told = test::messageOf([&] { set_.commit(); });
    EXPECT_EQ(told,
              second_.path().string() + ": no picture; " + third_.path().string() + "/x: full");
    EXPECT_THAT(names(), testing::ElementsAre("a"));
    EXPECT_EQ(test::readFile(folder_ / "a"), "new");
}

TEST_F(OutputSetTest, TellsWhenAllAreGivenUp) {
    for (const OutputPath* const output : {&first_, &second_, &third_}) {
        EXPECT_FALSE(set_.areAllGivenUp());
        set_.write(*output, [] { throw std::runtime_error("no"); });
    }
    EXPECT_TRUE(set_.areAllGivenUp());
    EXPECT_THAT(set_.failures(), HasSubstr(second_.path().string() + ": no; "));
}

TEST_F(OutputSetTest, ANameThatIsTakenMeanwhileDoesNotCostTheOthers) {
    for (const OutputPath* const output : {&first_, &second_, &third_}) write(*output);
    folder_.write("a", "theirs");
    EXPECT_THAT(test::messageOf([&] { set_.commit(); }),
                AllOf(HasSubstr("a exists"), HasSubstr("this run's output is"),
                      Not(HasSubstr(second_.path().string()))));
    EXPECT_EQ(test::readFile(folder_ / "a"), "theirs");
    EXPECT_EQ(test::readFile(folder_ / "a.partial"), "new");
    EXPECT_EQ(test::readFile(folder_ / "b"), "new");
    EXPECT_EQ(test::readFile(folder_ / "c"), "new");
}

/// As a killed process would leave it.
TEST_F(OutputSetTest, ANoteTellsWhichNamesAreComingAndGoesWithTheLast) {
    struct Last {
        std::function<void()> commit;
    };
    std::string note;
    Last last{[&] {
        for (const std::string& name : names()) {
            if (name.find(".unfinished-") != std::string::npos)
                note = test::readFile(folder_ / name);
        }
    }};
    const OutputPath fourth(folder_ / "d", kFile, false);
    set_.add(fourth, last);
    for (const OutputPath* const output : {&first_, &second_, &third_}) write(*output);
    set_.commit();
    for (const char* name : {"/a\n", "/b\n", "/c\n", "/d\n"}) {
        EXPECT_THAT(note, HasSubstr(name));
    }
    EXPECT_THAT(names(), testing::UnorderedElementsAre("a", "b", "c"));
}

TEST_F(OutputSetTest, AnotherOutputIsAnErrorOfTheProgram) {
    const OutputPath other(folder_ / "x", kFile, false);
    EXPECT_THROW(set_.write(other, [] {}), std::logic_error);
}

}  // namespace
}  // namespace hagen::base
