#pragma once
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "support/Program.h"

namespace hagen::test {

using Arguments = std::vector<std::string>;

/// Tests that run a built program with outputs in a temporary folder.
class ProgramTest : public testing::Test {
 protected:
    using Arguments = test::Arguments;

    /// Runs the program with the fixture's common arguments and additional arguments.
    virtual Outcome run(const Arguments& arguments) const = 0;

    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    /// Runs the program and expects exit code 0.
    Outcome expectSuccess(const Arguments& arguments) const {
        Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome;
    }

    /// Expects an error message on standard error, nothing on standard output, and no output files.
    void expectFailure(const Arguments& arguments, int exit_code, const std::string& words) const {
        const std::set<std::filesystem::path> before = files();
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, exit_code) << words << "\n" << outcome.err;
        EXPECT_THAT(outcome.err, testing::HasSubstr(words));
        EXPECT_EQ(outcome.out, "") << words;
        EXPECT_EQ(files(), before) << words;
    }

    /// Like expectFailure() for several cases of additional arguments and words of the message.
    void expectFailures(const Arguments& common, int exit_code,
                        const std::vector<std::pair<Arguments, std::string>>& cases) const {
        for (const auto& [arguments, words] : cases) {
            expectFailure(with(common, arguments), exit_code, words);
        }
    }

    std::set<std::filesystem::path> files() const {
        return {std::filesystem::recursive_directory_iterator(folder_.path()), {}};
    }
    void expectNoTemporaryFiles() const {
        for (const auto& file : files()) {
            EXPECT_THAT(file.string(), testing::Not(testing::HasSubstr("tmp-")));
        }
    }

    nlohmann::json readJson(const std::string& name) const {
        return nlohmann::json::parse(readFile(path(name)));
    }

    static Arguments with(Arguments arguments, const Arguments& more) {
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    TemporaryFolder folder_;
};

}  // namespace hagen::test
