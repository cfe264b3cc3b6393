#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "support/Program.h"

namespace hagen::test {

/// Tests that run a built program, which writes into a temporary folder.
class ProgramTest : public testing::Test {
 protected:
    /// Runs the program with the fixture's common arguments and these.
    virtual Outcome run(const std::vector<std::string>& arguments) const = 0;

    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    /// Expects an error message on standard error, nothing on standard output, and no output files.
    void expectFailure(const std::vector<std::string>& arguments, int exit_code,
                       const std::string& words) const {
        const std::set<std::filesystem::path> before = files();
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
        EXPECT_THAT(outcome.err, testing::HasSubstr(words));
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(files(), before);
    }

    /// All files in the folder.
    std::set<std::filesystem::path> files() const {
        return {std::filesystem::recursive_directory_iterator(folder_.path()), {}};
    }

    static std::vector<std::string> with(std::vector<std::string> arguments,
                                         const std::vector<std::string>& more) {
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    TemporaryFolder folder_;
};

}  // namespace hagen::test
