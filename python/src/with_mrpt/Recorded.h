#pragma once
#include <hagen/recordings/ScanSource.h>

#include <memory>

#include "PythonScan.h"

namespace hagen::python {

struct Recorded {
    recordings::RecordedScan scan;
    /// The recording, which may name the sensor; null for simulated scans.
    std::shared_ptr<const recordings::ScanSource> source;
};

/// Reads the scan, whose returns keep their order. Requires the GIL, and releases it while reading.
/// Throws std::runtime_error naming the entry.
PythonScan pythonScanOf(Recorded recorded);

}  // namespace hagen::python
