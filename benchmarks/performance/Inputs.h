// The scans used for timing.
#pragma once
#include <hagen/filter/Options.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <string>
#include <vector>

namespace hagen {

/// Scans of one sensor in its native format: packets if MRPT supports them, otherwise coordinates.
struct Input {
    SensorModel model;
    int columns = Options().columns;  ///< of the image
    std::vector<mrpt::obs::CObservationVelodyneScan::Ptr> packets = {};
    std::vector<Scan> points = {};  ///< coordinates and intensities only; empty if packets exist

    std::size_t size() const { return packets.empty() ? points.size() : packets.size(); }
};

/// Simulates `scans` consecutive scans at 10 Hz in each of four scenes, as packets of a "VLP-16" or
/// "HDL-32E".
Input simulatedPackets(const std::string& sensor, int scans);

/// Likewise, as coordinates from an OS1-128 with this many firings per revolution, one return per
/// pixel.
Input simulatedOs1(int columns, int scans);

/// Reads the first `scans` scans of each drive in $HAGEN_LABELLED_DATA/beams64, with the beams of
/// the last. Throws std::runtime_error if they cannot be read.
Input realScansOf64Beams(int scans);

}  // namespace hagen
