#pragma once
#include <hagen/sensors/Datagram.h>
#include <hagen/sensors/LidarDriver.h>

#include <memory>
#include <vector>

#include "sensors/SweepReader.h"

namespace hagen::sensors {

/// A vendor's sensors that need neither metadata nor calibration.
struct LidarFamily {
    const char* model;   ///< for makeDriver(); a known sensorModel()
    const char* called;  ///< in errors: "a Livox"
    /// True if a datagram is data of these sensors and of no others.
    bool (*isData)(const Datagram& datagram);
    std::unique_ptr<LidarDriver> (*makeDriver)();
    std::unique_ptr<SweepReader> (*makeSweeps)();
};

/// All families except Velodyne and Ouster. Drivers, captures and --help read this list.
const std::vector<LidarFamily>& lidarFamilies();

}  // namespace hagen::sensors
