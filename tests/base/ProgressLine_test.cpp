#include "base/command_line/ProgressLine.h"
#include <gmock/gmock.h>

#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <functional>
#include <regex>
#include <stdexcept>

namespace hagen::base {
namespace {

/// The output to standard error if it is a terminal.
std::string onTerminal(const std::function<void()>& write) {
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
    if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0) {
        throw std::runtime_error("no pseudoterminal");
    }
    const int program_side = open(ptsname(terminal), O_RDWR | O_NOCTTY);
    const int before = dup(STDERR_FILENO);
    dup2(program_side, STDERR_FILENO);
    write();
    dup2(before, STDERR_FILENO);
    close(before);
    close(program_side);
    std::string text, part(1000, 0);  // arrives in parts; after the last one, reading fails
    for (ssize_t size = 0; (size = read(terminal, part.data(), part.size())) > 0;) {
        text.append(part, 0, static_cast<std::size_t>(size));
    }
    close(terminal);
    return std::regex_replace(text, std::regex("[0-9]+ s "), "N s ");
}

constexpr const char* kClear = "\r\033[K";

TEST(ProgressLine, UpdatesOneLineOnTerminal) {
    const std::string shown = onTerminal([] {
        ProgressLine line("scan");
        for (const std::size_t done : {0, 0, 1, 2}) line.show(done, 2);
    });
    const std::string clear = kClear;
    EXPECT_EQ(shown, clear + "scan 0 of 2" + clear + "scan 1 of 2, about N s left" + clear + clear);
    EXPECT_EQ(onTerminal([] { ProgressLine("scan").show(0, 2); }), clear + "scan 0 of 2" + clear);
    EXPECT_EQ(onTerminal([] { ProgressLine("scan").show(0, 0); }), "");
}

TEST(ProgressLine, PrintsLinePerTenthWithoutTerminal) {
    testing::internal::CaptureStderr();
    {
        ProgressLine line("flight");
        for (std::size_t done = 0; done <= 30; ++done) line.show(done, 30);
    }
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 11);
    EXPECT_THAT(text, testing::StartsWith("flight 0 of 30\nflight 3 of 30, about "));
    EXPECT_THAT(text, testing::HasSubstr("flight 30 of 30\n"));
}

}  // namespace
}  // namespace hagen::base
