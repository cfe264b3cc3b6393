#pragma once

namespace hagen::base {

/// Shuts a program down cleanly: after SIGINT, SIGTERM, SIGHUP, SIGXCPU (a limit of CPU time) or
/// another signal that would end it, unless ignored, isInterrupted() returns true. A later signal
/// ends the program at once.
void catchSignals();

/// Ignores SIGPIPE and SIGXFSZ, so that the failed write reports the error. Each Program does.
void ignoreWriteSignals();

bool isInterrupted();

}  // namespace hagen::base
