#pragma once
#include <string>
#include <vector>

namespace hagen {

/// The geometry of a rotating LiDAR.
struct SensorModel {
    std::string name;
    /// Elevation of each beam above the sensor's xy plane, strictly increasing: element r belongs
    /// to image row r; row 0 is the lowest beam.
    std::vector<float> elevations_rad;
    /// Returns outside these limits are unclassified.
    float min_range_m = 0.5f;
    float max_range_m = 130.0f;

    /// Whether a range is within the sensor's limits; false for NaN.
    bool sees(float range_m) const { return range_m >= min_range_m && range_m <= max_range_m; }

    int rows() const { return static_cast<int>(elevations_rad.size()); }

    /// The row of the beam closest in elevation (the lower of two equally close ones).
    int nearestRow(float elevation_rad) const;
};

/// A known sensor by its name in settings files: "VLP-16", "HDL-32E", "HDL-64E", "Puck Hi-Res",
/// "VLP-32C". Elevations and range limits are from the manufacturer's data sheets. Throws
/// std::invalid_argument for any other name, listing the known ones.
SensorModel sensorModel(const std::string& name);

/// The names that sensorModel() knows.
std::vector<std::string> knownSensorModels();

/// A sensor with these beams, from lowest to highest.
/// Throws std::invalid_argument unless there are 2 to 256 finite, strictly increasing elevations
/// within +-90 degrees.
SensorModel customSensorModel(const std::vector<double>& elevations_deg);

}  // namespace hagen
