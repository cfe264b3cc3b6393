#pragma once
#include <hagen/scan/Scan.h>

namespace hagen {

/// checkLocated() but for the coordinates, which a range image does not need.
void checkRows(const Scan& scan, const SensorModel& sensor);

}  // namespace hagen
