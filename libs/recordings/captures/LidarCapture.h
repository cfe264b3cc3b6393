#pragma once
#include <hagen/sensors/CaptureFile.h>
#include <mrpt/obs/CObservation.h>
#include "sensors/livox/SweepReader.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hagen::recordings {

/// A sweep as an observation: packets of a Velodyne as a CObservationVelodyneScan, other returns as
/// a LocatedCloud in a CObservationPointCloud. Its pose is that of the beams' origin on the
/// sensor's base.
mrpt::obs::CObservation::Ptr observationOf(const sensors::LidarSweep& sweep);

/// The scans of a capture, in the order in which they end. The first and the last one may be
/// partial.
class LidarCapture {
 public:
    /// `reader`: of the vendor. Throws BrokenCapture naming the file if it cannot be opened.
    LidarCapture(const std::filesystem::path& file, std::unique_ptr<sensors::SweepReader> reader);

    /// The next scan; null at the end. Where the capture breaks off, the scans in progress come
    /// first. Throws BrokenCapture there, and at the end if there was no packet.
    mrpt::obs::CObservation::Ptr nextScan();

    /// Like CaptureFile::checkWhileReading(): an exception of `check` ends nextScan().
    void checkWhileReading(const std::function<void()>& check) {
        capture_.checkWhileReading(check);
    }

    /// Fraction of the file read so far, 0 ... 1.
    double fractionRead() const { return capture_.fractionRead(); }

    /// Counts of each sensor, of the frames, and of all that was lost or ignored. Complete at the
    /// end.
    std::vector<std::string> remarks() const;

 private:
    void read();

    std::filesystem::path file_;
    sensors::CaptureFile capture_;
    std::unique_ptr<sensors::SweepReader> reader_;
    bool is_at_end_ = false;
    std::string broken_because_;
};

/// Opens a capture of Velodyne or Livox sensors, recognised by the first packets, or of the Ouster
/// of a metadata file. `calibration`: of an HDL-64E. Throws std::runtime_error naming the file that
/// cannot be opened, and if a calibration is given for another kind of sensor. The capture calls
/// `check` as by checkWhileReading(), also while it is opened.
std::unique_ptr<LidarCapture> openCapture(const std::filesystem::path& file,
                                          const std::filesystem::path& sensor_json = {},
                                          const std::filesystem::path& calibration = {},
                                          const std::function<void()>& check = {});

}  // namespace hagen::recordings
