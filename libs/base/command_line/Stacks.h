#pragma once
#include <functional>

namespace hagen::base {

/// Returns what `work`, which must not throw, returns; with as much room on the stacks of this and
/// of later threads as Linux gives where nobody has set `ulimit -s`. The stack that a program
/// begins with cannot be enlarged, so the work is done on a thread of its own if that is small.
int withRoomyStacks(const std::function<int()>& work) noexcept;

}  // namespace hagen::base
