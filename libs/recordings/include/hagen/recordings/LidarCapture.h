#pragma once
#include <hagen/sensors/CaptureFile.h>
#include <mrpt/obs/CObservation.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hagen::recordings {

/// The scans in a capture.
class LidarCapture {
 public:
    virtual ~LidarCapture() = default;

    /// The next scan; null at the end. Where the capture breaks off, the scans in progress come
    /// first. Throws BrokenCapture there, and at the end if there was no packet.
    virtual mrpt::obs::CObservation::Ptr nextScan() = 0;

    /// Like CaptureFile::checkWhileReading(): what `check` throws ends nextScan().
    virtual void checkWhileReading(const std::function<void()>& check) = 0;

    /// Fraction of the file read so far, 0 ... 1.
    virtual double fractionRead() const = 0;

    /// What was found, with figures: the frames, each sensor, and all that was lost or left out.
    /// Complete at the end.
    virtual std::vector<std::string> remarks() const = 0;
};

/// Opens a capture of Velodyne sensors, or of the Ouster whose metadata file is given.
/// `calibration` is of an HDL-64E. Throws std::runtime_error naming the file that cannot be opened
/// or is none, and if a calibration is given for another kind of sensor. The kind of sensor is
/// known by the first packets: what `check` throws meanwhile ends it. The capture that is returned
/// calls it, too, as by checkWhileReading().
std::unique_ptr<LidarCapture> openCapture(const std::filesystem::path& file,
                                          const std::filesystem::path& sensor_json = {},
                                          const std::filesystem::path& calibration = {},
                                          const std::function<void()>& check = {});

}  // namespace hagen::recordings
