#pragma once

namespace hagen::live {

/// Under a real-time policy, lowers the calling thread's priority by one, if there is a lower one.
/// Threads of equal priority under SCHED_FIFO do not take turns: on one core, who labels packets
/// that wait would let nobody receive or send until none is left.
void lowerPriority();

/// Gives up a real-time policy for the calling thread.
void leaveRealTime();

}  // namespace hagen::live
