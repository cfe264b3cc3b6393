#pragma once
#include <hagen/mrpt/ObservationSegmenter.h>
#include <hagen/recordings/ScanSource.h>
#include "scan/BeamFit.h"

#include <map>
#include <string>
#include <utility>

namespace hagen::recordings {

/// Compares the first clouds of each LiDAR with the sensor named in the settings or a sensor.yaml.
/// Skips packets, because they identify their sensor, and recovered beams, because they always fit.
class SensorCheck {
 public:
    /// `recording`: name used in messages.
    explicit SensorCheck(std::string recording) : recording_(std::move(recording)) {}

    static constexpr int kClouds = 5;  ///< clouds to check; only the best fit matters

    /// Checks a segmented scan. At the last cloud to check, returns a remark for the user, or "",
    /// or throws std::runtime_error if less than half of the cloud fits.
    std::string see(const RecordedScan& recorded,
                    const observations::ObservationSegmenter::Output& segmented);

    /// Like see(), at the end of the recording, for LiDARs with fewer clouds. Returns remarks by
    /// sensor label.
    std::map<std::string, std::string> finish();

    /// Such as "98.1 % of the returns lie on them"; empty if unknown.
    std::string textOf(const std::string& sensor_label) const;

 private:
    struct Seen {
        int clouds = 0;
        BeamFit best;
        std::string sensor;
        int rows = 0;
    };
    /// Returns a remark or "". Throws std::runtime_error if the cloud does not fit.
    std::string judge(const std::string& title, const Seen& seen) const;

    const std::string recording_;
    std::map<std::string, Seen> seen_;
};

}  // namespace hagen::recordings
