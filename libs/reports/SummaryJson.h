#pragma once
#include <hagen/base/Json.h>
#include <hagen/reports/Summary.h>

namespace hagen::reports {

/// All of a summary; what is NaN is null.
base::Json jsonOf(const Summary& summary);

}  // namespace hagen::reports
