#pragma once

namespace hagen::live {

/// Lowers the calling thread's real-time priority by one if possible. SCHED_FIFO threads of equal
/// priority do not take turns, so on a single core, labelling would block receiving and sending
/// until the queue is empty.
void lowerPriority();

/// Switches the calling thread to the default scheduling policy.
void leaveRealTime();

}  // namespace hagen::live
