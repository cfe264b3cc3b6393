#pragma once
#include <hagen/recordings/ScanSource.h>
#include <hagen/settings/Settings.h>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hagen::convert {

/// A recording to learn the airframe from, and the file to write.
struct AirframeLearning {
    std::filesystem::path input;       ///< a rawlog, a capture, a bag, or a scan folder
    recordings::SourceOptions source;  ///< which scans to read, of one LiDAR; without callbacks
    std::filesystem::path file;        ///< FILE.yaml; the picture is FILE.png
    bool overwrite = false;            ///< replace existing outputs
    double seconds = 10;               ///< duration to use, from the first selected scan
    Settings settings;                 ///< settings of the sensor; their airframe is ignored
};

struct AirframeReport {
    std::string sensor_label;
    std::size_t scans = 0;             ///< scans used for learning
    std::size_t unreadable_scans = 0;  ///< scans reported as unreadable
    int bins = 0;                      ///< number of masked bins
    double share_of_sphere = 0;        ///< masked fraction of the sphere
    double share_of_seen = 0;          ///< masked fraction of the bins with a return
    std::filesystem::path picture;
    /// True if the mask is so large that it probably covers more than the airframe.
    bool isSuspicious() const { return share_of_sphere > 0.2 || share_of_seen > 0.2; }
};

struct AirframeListener {
    /// Called with the title of a scan that could not be read and is skipped, and the reason.
    std::function<void(const std::string& entry, const std::string& why)> unreadable =
        [](const auto&, const auto&) {};
    /// Called with remarks about the recording, such as ignored content.
    std::function<void(const std::string& what)> remark = [](const auto&) {};
    /// Called before reading each entry. Returning false ends learning with Interrupted, without
    /// output.
    std::function<bool()> keep_going = [] { return true; };
};

/// Learns the airframe from the first seconds of a recording (AirframeLearner), and writes it as a
/// file for `airframe: [{learned: FILE}]` with a picture. Throws std::runtime_error naming the
/// recording if it has no scans, too few scans (AirframeRules::min_scans), or scans of several
/// LiDARs, or naming the output if it cannot be written. In both cases, no output is left.
AirframeReport learnAirframe(const AirframeLearning& learning,
                             const AirframeListener& listener = {});

}  // namespace hagen::convert
