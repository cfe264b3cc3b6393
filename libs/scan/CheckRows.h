#pragma once
#include <hagen/scan/Scan.h>

namespace hagen {

/// Like checkLocated(), but does not check coordinates, which a range image does not need.
void checkRows(const Scan& scan, const SensorModel& sensor);

}  // namespace hagen
