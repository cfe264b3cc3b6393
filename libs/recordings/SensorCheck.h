#pragma once
#include <hagen/mrpt/ObservationSegmenter.h>
#include <hagen/recordings/ScanSource.h>
#include "scan/BeamFit.h"

#include <map>
#include <string>
#include <utility>

namespace hagen::recordings {

/// Compares the first clouds of each LiDAR with the sensor named in the settings or a sensor.yaml.
/// Skips packets, which identify their sensor, and recovered beams, which fit by definition.
class SensorCheck {
 public:
    /// Messages name the recording.
    explicit SensorCheck(std::string recording) : recording_(std::move(recording)) {}

    static constexpr int kClouds = 5;  ///< clouds to check; the best fit counts

    /// Checks a segmented scan. At the last of the clouds, returns a remark for the user, if any,
    /// or throws std::runtime_error if less than half of the cloud fits.
    std::string see(const RecordedScan& recorded,
                    const observations::ObservationSegmenter::Output& segmented);

    /// The same at the end of the recording, for LiDARs with fewer clouds. Returns remarks by
    /// sensor label.
    std::map<std::string, std::string> finish();

    /// "98.1 % of the returns lie on them"; empty: unknown.
    std::string textOf(const std::string& sensor_label) const;

 private:
    struct Seen {
        int clouds = 0;
        BeamFit best;
        std::string sensor;  ///< name
        int rows = 0;        ///< number of beams
    };
    /// Returns a remark or "". Throws if the cloud does not fit.
    std::string judge(const std::string& title, const Seen& seen) const;

    const std::string recording_;
    std::map<std::string, Seen> seen_;
};

}  // namespace hagen::recordings
