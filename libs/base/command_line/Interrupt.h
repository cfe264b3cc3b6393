#pragma once

namespace hagen::base {

/// Enables a clean shutdown: after SIGINT, SIGTERM, SIGHUP, SIGXCPU (CPU time limit) or another
/// terminating signal, isInterrupted() returns true. Ignored signals stay ignored. A second signal
/// more than a second later terminates the program.
void catchSignals();

/// Ignores SIGPIPE and SIGXFSZ, so that write calls return errors instead.
void ignoreWriteSignals();

bool isInterrupted();

}  // namespace hagen::base
