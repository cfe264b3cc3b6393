#pragma once

namespace hagen::command_line {

/// Shuts a program down cleanly: after SIGINT, SIGTERM or SIGHUP (unless ignored) isInterrupted()
/// returns true; a later signal ends the program at once. SIGPIPE and SIGXFSZ are ignored, so that
/// the failed write reports the error.
void catchSignals();

bool isInterrupted();

}  // namespace hagen::command_line
