#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/convert/Conversion.h>
#include <hagen/mrpt/ObservationSegmenter.h>
#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>
#include "base/Json.h"

namespace hagen::convert {

/// A self-contained HTML page that plays the segmented scans (docs/view.md).
class ViewOutput {
 public:
    /// If `every` is 0, the page shows every scan, or every 2nd, 4th, 8th ... scan, so that it has
    /// at most 500 scans and 40 MB; with several LiDARs, that is of each LiDAR. Throws
    /// std::runtime_error naming the file; see OutputPath.
    ViewOutput(const std::filesystem::path& file, std::size_t every, bool overwrite);

    void write(const ScanReport& report,
               const observations::ObservationSegmenter::Output& segmented);
    /// Writes the page. Statistics are those of all scans.
    void finish(const Conversion& conversion, const ConversionReport& report);

    std::size_t frames() const { return frames_.size(); }
    std::size_t every() const { return every_; }

    void commit() { path_.commit(); }
    std::filesystem::path keepPartial() { return path_.keepPartial(); }

 private:
    base::Json poseOf(const observations::ObservationSegmenter::Output& segmented,
                      const Eigen::Matrix3f& image_from_sensor);

    base::OutputPath path_;
    bool is_thinned_;
    std::size_t every_, scans_ = 0, bytes_ = 0;
    struct Frame {
        std::size_t scan;  ///< its index in ConversionReport::scan_reports
        std::size_t scan_of_lidar;
        std::string json;
    };
    std::vector<Frame> frames_;
    std::map<std::string, std::size_t> scans_of_lidar_;  ///< by sensor label
    std::optional<Eigen::Vector3d> origin_m_;  ///< of the page, in the map: the first position
};

}  // namespace hagen::convert
