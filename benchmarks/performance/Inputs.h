// The scans used for timing.
#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <string>
#include <vector>

namespace hagen {

/// Scans of one sensor in its native format: packets if MRPT supports them, otherwise coordinates.
struct Input {
    std::string sensor;  ///< for tables, such as "VLP-16 simulated"
    SensorModel model;
    std::vector<mrpt::obs::CObservationVelodyneScan::Ptr> packets;
    std::vector<Scan> points;  ///< coordinates and intensities only; empty if packets exist

    std::size_t size() const { return packets.empty() ? points.size() : packets.size(); }
};

/// Returns the real VLP-16 scan of Debian's mrpt-common. Throws std::runtime_error if it is
/// missing.
Input realVlp16();

/// Returns one simulated scan of each of four scenes. Packets for "VLP-16" and "HDL-32E",
/// coordinates for "HDL-64E".
Input simulatedScans(const std::string& sensor);

/// Returns one orchard scan by a sensor with `beams` beams between -25 and 15 degrees and `columns`
/// firings per revolution, with one return per pixel. Its name is like "16 x 870".
Input gridScan(int beams, int columns);

}  // namespace hagen
