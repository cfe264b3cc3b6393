#pragma once
#include <hagen/range_image/Label.h>
#include <hagen/range_image/Scan.h>
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// What a method is given of a scan.
struct ScanInput {
    Scan scan;  ///< with range, azimuth and row
    /// Turns directions of the sensor's frame into the map's, whose z points up. None where the
    /// pose is not known.
    std::optional<Eigen::Matrix3f> map_from_sensor;
};

/// A way to segment scans of one sensor, by the name it has in tables: the filter, or one to
/// compare it with. `segment` gives a label for each return of the scan.
struct Method {
    std::string name;
    std::function<std::vector<Label>(const ScanInput& input)> segment;
};

}  // namespace hagen::evaluation
