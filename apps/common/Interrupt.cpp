#include "Interrupt.h"

#include <csignal>
#include <ctime>
#include <initializer_list>

namespace hagen {
namespace {

volatile std::sig_atomic_t is_interrupted = 0;
volatile std::time_t interrupted_at = 0;

/// Shells and timeout(1) may send the same signal twice: only a later one ends the program at once.
void interrupt(int signal) {
    const std::time_t now = std::time(nullptr);
    if (is_interrupted == 0) {
        is_interrupted = 1;
        interrupted_at = now;
    } else if (now > interrupted_at + 1) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
}

}  // namespace

void catchSignals() {
    for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {};
        sigaction(signal, nullptr, &action);
        if (action.sa_handler == SIG_IGN) continue;  // as nohup wants it
        action = {};
        action.sa_handler = interrupt;
        action.sa_flags = SA_RESTART;
        sigaction(signal, &action, nullptr);
    }
}

bool isInterrupted() { return is_interrupted != 0; }

}  // namespace hagen
