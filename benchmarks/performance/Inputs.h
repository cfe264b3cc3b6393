// The scans that are timed.
#pragma once
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <string>
#include <vector>

namespace hagen {

/// Scans of one sensor as they come from it: packets where MRPT knows them, else coordinates.
struct Input {
    std::string sensor;  ///< for tables, such as "VLP-16 simulated"
    SensorModel model;
    std::vector<mrpt::obs::CObservationVelodyneScan::Ptr> packets;
    std::vector<Scan> points;  ///< coordinates and intensities alone; empty where there are packets

    std::size_t size() const { return packets.empty() ? points.size() : packets.size(); }
};

/// The real VLP-16 scan of Debian's mrpt-common. Throws std::runtime_error where it is missing.
Input realVlp16();

/// Simulated scans, one of each of four scenes. Of "VLP-16" and "HDL-32E" packets, of "HDL-64E"
/// coordinates.
Input simulatedScans(const std::string& sensor);

/// One scan of an orchard by a sensor of `beams` beams between 25 degrees down and 15 up that fires
/// `columns` times a turn: a return a pixel. Its name is "16 x 870".
Input gridScan(int beams, int columns);

}  // namespace hagen
