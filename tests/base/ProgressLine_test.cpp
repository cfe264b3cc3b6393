#include <gtest/gtest.h>
#include <hagen/base/ProgressLine.h>
#include <hagen/base/Terminal.h>

#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>

namespace hagen::base {
namespace {

/// What is written to standard error if it is a terminal.
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
    // Arrives in parts; after the last one, reading fails.
    std::string text, part(1000, 0);
    for (ssize_t size = 0; (size = read(terminal, part.data(), part.size())) > 0;) {
        text.append(part, 0, static_cast<std::size_t>(size));
    }
    close(terminal);
    return text;
}

/// A busy machine may need more than 0 s.
std::string withoutSeconds(std::string text) {
    const std::string before = "about ";
    for (std::size_t at = text.find(before); at != std::string::npos; at = text.find(before, at)) {
        at += before.size();
        const std::size_t end = text.find_first_not_of("0123456789", at);
        if (end > at && text.compare(end, 2, " s") == 0) text.replace(at, end - at, "N");
    }
    return text;
}

std::string clearing() {
    std::ostringstream text;
    text << clearLine;
    return text.str();
}

TEST(ProgressLine, UpdatesOneLineOnTerminal) {
    const std::string clear = clearing();
    const std::string shown = onTerminal([] {
        ProgressLine line("scan");
        line.show(0, 2);
        line.show(0, 2);  // nothing new
        line.show(1, 2);
        line.show(2, 2);
    });
    EXPECT_EQ(withoutSeconds(shown),
              clear + "scan 0 of 2" + clear + "scan 1 of 2, about N s left" + clear + clear);
}

TEST(ProgressLine, ClearsUnfinishedLine) {
    const std::string clear = clearing();
    EXPECT_EQ(onTerminal([] { ProgressLine("scan").show(0, 2); }), clear + "scan 0 of 2" + clear);
    EXPECT_EQ(onTerminal([] { ProgressLine("scan").show(0, 0); }), "");
}

TEST(ProgressLine, PrintsLinePerTenthElsewhere) {
    testing::internal::CaptureStderr();
    {
        ProgressLine line("flight");
        for (std::size_t done = 0; done <= 30; ++done) line.show(done, 30);
    }
    const std::string text = withoutSeconds(testing::internal::GetCapturedStderr());
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 11);
    EXPECT_EQ(text.find("flight 0 of 30\nflight 3 of 30, about N s left\n"), 0u) << text;
    EXPECT_NE(text.find("flight 30 of 30\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace hagen::base
