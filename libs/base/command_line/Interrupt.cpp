#include "base/command_line/Interrupt.h"

#include <atomic>
#include <csignal>
#include <ctime>
#include <initializer_list>

namespace hagen::base {
namespace {

// Signals may arrive on any thread, and any thread may call isInterrupted().
std::atomic<bool> is_interrupted{false};
std::atomic<std::time_t> interrupted_at{0};
static_assert(std::atomic<bool>::is_always_lock_free &&
              std::atomic<std::time_t>::is_always_lock_free);

/// The second signal kills the program, unless it arrives within a second of the first, because
/// shells and timeout(1) may send a signal twice in a row.
void interrupt(int signal) {
    const std::time_t now = std::time(nullptr);
    std::time_t before = 0;
    if (interrupted_at.compare_exchange_strong(before, now)) {
        is_interrupted = true;
    } else if (now > before + 1 && signal != SIGXCPU) {  // the kernel repeats SIGXCPU every second
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
}

}  // namespace

void ignoreWriteSignals() {
    for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

void catchSignals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGQUIT, SIGUSR1, SIGUSR2, SIGALRM,
                             SIGVTALRM, SIGPWR}) {
        struct sigaction action {};
        sigaction(signal, nullptr, &action);
        if (action.sa_handler == SIG_IGN) continue;  // nohup ignores SIGHUP
        action = {};
        action.sa_handler = interrupt;
        action.sa_flags = SA_RESTART;
        sigaction(signal, &action, nullptr);
    }
}

bool isInterrupted() { return is_interrupted; }

}  // namespace hagen::base
