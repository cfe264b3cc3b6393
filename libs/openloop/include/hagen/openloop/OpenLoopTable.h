#pragma once
#include <hagen/openloop/OpenLoop.h>
#include <string>

namespace hagen::openloop {

/// What was digested, a line a model, and how they agree; for a terminal.
std::string tableOf(const OpenLoop& open_loop, const OpenLoopResult& result);

}  // namespace hagen::openloop
