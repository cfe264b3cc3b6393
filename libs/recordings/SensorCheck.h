#pragma once
#include <hagen/mrpt/ObservationSegmenter.h>
#include <hagen/recordings/ScanSource.h>
#include "scan/BeamFit.h"

#include <map>
#include <string>
#include <utility>

namespace hagen::recordings {

/// Compares the first clouds of each LiDAR with the sensor that the settings or a sensor.yaml say
/// they are from. Packets know their sensor, and recovered beams are those of the clouds; both are
/// not looked at.
class SensorCheck {
 public:
    /// The recording is named in messages.
    explicit SensorCheck(std::string recording) : recording_(std::move(recording)) {}

    static constexpr int kClouds = 5;  ///< that are looked at; the one that fits best counts

    /// Looks at a segmented scan. Returns a remark for the user, if there is one, at the last of
    /// the clouds. Throws std::runtime_error there if less than half of the cloud fits.
    std::string see(const RecordedScan& recorded,
                    const observations::ObservationSegmenter::Output& segmented);

    /// The same for the LiDARs with fewer clouds, once the recording is at its end. Returns a
    /// remark by sensor label.
    std::map<std::string, std::string> finish();

    /// "98.1 % of the returns lie on them"; empty: not known.
    std::string textOf(const std::string& sensor_label) const;

 private:
    struct Seen {
        int clouds = 0;
        BeamFit best;
        std::string sensor;  ///< its name
        int rows = 0;        ///< its beams
    };
    /// A remark or none. Throws if it does not fit.
    std::string judge(const std::string& title, const Seen& seen) const;

    const std::string recording_;
    std::map<std::string, Seen> seen_;
};

}  // namespace hagen::recordings
