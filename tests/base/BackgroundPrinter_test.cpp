#include "base/command_line/BackgroundPrinter.h"
#include <gtest/gtest.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>

namespace hagen::base {
namespace {

using std::chrono::milliseconds;
using To = BackgroundPrinter::To;

TEST(BackgroundPrinter, PrintsInOrder) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    BackgroundPrinter printer;
    for (int i = 0; i < 100; ++i) {
        printer.print(i % 2 == 0 ? To::Output : To::Errors, std::to_string(i) + " ");
    }
    EXPECT_TRUE(printer.finish(std::chrono::seconds(60)));
    printer.print(To::Output, "late");
    std::string even, odd;
    for (int i = 0; i < 100; ++i) (i % 2 == 0 ? even : odd) += std::to_string(i) + " ";
    EXPECT_EQ(testing::internal::GetCapturedStdout(), even);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), odd);
}

/// Redirects standard error to a full pipe.
class FullErrors {
 public:
    FullErrors() {
        EXPECT_EQ(pipe(ends_), 0);
        fcntl(ends_[1], F_SETPIPE_SZ, kPipe);
        EXPECT_EQ(write(ends_[1], std::string(kPipe, '.').data(), kPipe), kPipe);
        usual_ = dup(STDERR_FILENO);
        dup2(ends_[1], STDERR_FILENO);
        close(ends_[1]);
    }
    ~FullErrors() { endAndRead(); }

    /// Reads at most `bytes` bytes.
    std::string read(std::size_t bytes) const {
        std::string all, part(kPipe, '\0');
        while (all.size() < bytes) {
            const ssize_t got =
                ::read(ends_[0], part.data(), std::min(bytes - all.size(), part.size()));
            if (got <= 0) break;
            all.append(part, 0, static_cast<std::size_t>(got));
        }
        return all;
    }
    /// Restores standard error; waiting threads continue. Returns the rest of the pipe.
    std::string endAndRead() {
        if (usual_ < 0) return "";
        dup2(usual_, STDERR_FILENO);
        close(usual_);
        usual_ = -1;
        const std::string rest = read(std::string::npos / 2);
        close(ends_[0]);
        return rest;
    }
    static constexpr int kPipe = 4096;

 private:
    int ends_[2]{}, usual_ = -1;
};

TEST(BackgroundPrinter, ReportsDroppedMessages) {
    FullErrors errors;
    {
        BackgroundPrinter printer;
        const std::size_t texts = BackgroundPrinter::kMaxWaiting + 50;
        for (std::size_t i = 0; i < texts; ++i) printer.print(To::Errors, "x\n");
        printer.printIfIdle(To::Errors, "status\n");
        EXPECT_EQ(errors.read(FullErrors::kPipe + 2 * 900).find("status"), std::string::npos);
        printer.print(To::Errors, "the last\n");
        EXPECT_TRUE(printer.finish(std::chrono::seconds(60)));
        EXPECT_TRUE(printer.isOutputPrinted());
    }
    const std::string rest = errors.endAndRead();
    EXPECT_NE(rest.find(" messages dropped: the terminal or pipe was blocked\nthe last\n"),
              std::string::npos)
        << rest;
}

TEST(BackgroundPrinter, ReportsUnprintedOutput) {
    FullErrors errors;
    for (const std::size_t texts : {std::size_t{1}, BackgroundPrinter::kMaxWaiting + 50}) {
        BackgroundPrinter printer;
        for (std::size_t i = 0; i < texts; ++i) printer.print(To::Errors, "x\n");
        printer.print(To::Output, "summary\n");
        EXPECT_FALSE(printer.finish(std::chrono::milliseconds(1)));
        EXPECT_FALSE(printer.isOutputPrinted()) << texts;
    }
    BackgroundPrinter without_output;
    without_output.print(To::Errors, "x\n");
    EXPECT_FALSE(without_output.finish(std::chrono::milliseconds(1)));
    EXPECT_TRUE(without_output.isOutputPrinted());
}

}  // namespace
}  // namespace hagen::base
