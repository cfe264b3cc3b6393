#pragma once
#include <hagen/sensors/CaptureFile.h>
#include "sensors/SweepReader.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hagen::sensors {

/// Reads the sweeps of a capture, ordered by end. The first and the last may be partial.
class LidarCapture {
 public:
    /// `reader`: parses packets. Throws BrokenCapture naming the file if it cannot be opened.
    LidarCapture(const std::filesystem::path& file, std::unique_ptr<SweepReader> reader);

    /// Returns the next sweep; nullopt at the end. If the capture is broken, returns the sweeps in
    /// progress and then throws BrokenCapture. Throws at the end if there were no packets.
    std::optional<LidarSweep> nextSweep();

    /// Like CaptureFile::checkWhileReading().
    void checkWhileReading(const std::function<void()>& check) {
        capture_.checkWhileReading(check);
    }

    double fractionRead() const { return capture_.fractionRead(); }

    /// Counts of packets per sensor, of frames, and of lost or ignored data. Complete at the end.
    std::vector<std::string> remarks() const;

 private:
    void read();

    std::filesystem::path file_;
    CaptureFile capture_;
    std::unique_ptr<SweepReader> reader_;
    bool is_at_end_ = false;
    std::string broken_because_;
};

/// Opens a capture of Velodyne, Livox or Hesai sensors (detected by their first packets), or of the
/// Ouster described by a metadata file. `calibration`: HDL-64E calibration. Throws
/// std::runtime_error naming the file if it cannot be opened, or if a calibration is given for
/// another kind of sensor. Calls `check` like checkWhileReading(), and also while opening.
std::unique_ptr<LidarCapture> openCapture(const std::filesystem::path& file,
                                          const std::filesystem::path& sensor_json = {},
                                          const std::filesystem::path& calibration = {},
                                          const std::function<void()>& check = {});

}  // namespace hagen::sensors
