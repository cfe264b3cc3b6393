#pragma once
#include <hagen/base/Json.h>
#include <hagen/reports/Summary.h>

namespace hagen::reports {

/// The whole summary; NaN is null.
base::Json jsonOf(const Summary& summary);

}  // namespace hagen::reports
