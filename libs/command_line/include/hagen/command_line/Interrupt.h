#pragma once

namespace hagen::command_line {

/// Lets a program end in an orderly way: after SIGINT, SIGTERM or SIGHUP (unless ignored)
/// isInterrupted() is true; another such signal, later, ends it at once. SIGPIPE and SIGXFSZ are
/// ignored, so that they show in the write that failed.
void catchSignals();

bool isInterrupted();

}  // namespace hagen::command_line
