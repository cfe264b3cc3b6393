#pragma once
#include <hagen/avoidance/OpenLoop.h>
#include <string>

namespace hagen::avoidance {

/// The result for a terminal: the log, one line per model, and the agreement of the models.
std::string tableOf(const OpenLoop& open_loop, const OpenLoopResult& result);

}  // namespace hagen::avoidance
