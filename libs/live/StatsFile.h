#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/live/LiveSession.h>

namespace hagen::live {

/// Writes the session statistics as JSON. Throws std::runtime_error naming the file if it cannot be
/// written.
void writeStats(const LiveReport& report, const LiveOptions& options, const LiveListener& listener,
                base::OutputPath& file);

}  // namespace hagen::live
