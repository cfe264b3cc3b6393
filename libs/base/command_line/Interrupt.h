#pragma once

namespace hagen::base {

/// For a clean shutdown: after SIGINT, SIGTERM, SIGHUP, SIGXCPU (CPU time limit) or another signal
/// that would end the program, isInterrupted() returns true. Ignored signals stay ignored. A signal
/// more than a second later ends the program.
void catchSignals();

/// Ignores SIGPIPE and SIGXFSZ, so that the failed write reports the error.
void ignoreWriteSignals();

bool isInterrupted();

}  // namespace hagen::base
