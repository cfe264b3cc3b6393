#pragma once
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// The input of a method for one scan.
struct ScanInput {
    Scan scan;  ///< with range, azimuth and row
    /// Rotates from the sensor's frame to the map frame (z up). nullopt if the pose is unknown.
    std::optional<Eigen::Matrix3f> map_from_sensor;
    std::string name = {};  ///< file name without folder and extension; empty if unknown
};

/// A segmenter for scans of one sensor and its name in tables: the filter or a baseline. `segment`
/// returns one label per return of the scan.
struct Method {
    std::string name;
    std::function<std::vector<Label>(const ScanInput& input)> segment;
    /// Labels are precomputed and only read by `segment`, which is not timed.
    bool is_recorded = false;
};

}  // namespace hagen::evaluation
