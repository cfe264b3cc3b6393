#pragma once
#include <hagen/scan/Scan.h>

namespace hagen {

/// checkLocated() without the check of coordinates, which a range image does not need.
void checkRows(const Scan& scan, const SensorModel& sensor);

}  // namespace hagen
