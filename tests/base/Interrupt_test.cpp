#include "base/command_line/Interrupt.h"
#include <gtest/gtest.h>

#include <csignal>

namespace hagen::base {
namespace {

/// Each signal is raised in its own process, as an uncaught signal would end it.
TEST(Interrupt, CatchesTerminatingSignals) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGQUIT, SIGUSR1}) {
        const auto wait = [&] {
            catchSignals();
            if (isInterrupted()) std::_Exit(1);
            std::raise(signal);
            std::raise(signal);  // shells may send a signal twice
            std::_Exit(isInterrupted() ? 7 : 2);
        };
        EXPECT_EXIT(wait(), testing::ExitedWithCode(7), "") << signal;
    }
}

TEST(Interrupt, KeepsIgnoredSignalsIgnored) {
    const auto wait = [] {
        std::signal(SIGHUP, SIG_IGN);  // like nohup
        catchSignals();
        std::raise(SIGHUP);
        std::_Exit(isInterrupted() ? 2 : 7);
    };
    EXPECT_EXIT(wait(), testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace hagen::base
