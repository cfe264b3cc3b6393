#pragma once
#include <string>
#include <vector>

namespace hagen {

/// The geometry of a rotating LiDAR.
struct SensorModel {
    std::string name;
    /// Elevation of each beam above the sensor's xy plane, strictly increasing: entry r is image
    /// row r, row 0 the lowest beam.
    std::vector<float> elevations_rad;
    /// Returns nearer or farther than these are unclassified.
    float min_range_m = 0.5f;
    float max_range_m = 130.0f;

    /// Whether a return at this range is within the sensor's limits; NaN is not.
    bool sees(float range_m) const { return range_m >= min_range_m && range_m <= max_range_m; }

    int rows() const { return static_cast<int>(elevations_rad.size()); }

    /// The row whose beam is closest in elevation (the lower one of two equally close).
    int nearestRow(float elevation_rad) const;
};

/// A known sensor by its name in settings files: "VLP-16", "HDL-32E", "HDL-64E", "Puck Hi-Res",
/// "VLP-32C". Elevations and range limits from the maker's data sheets.
/// Throws std::invalid_argument, naming the known ones, for any other name.
SensorModel sensorModel(const std::string& name);

/// The names that sensorModel() knows.
std::vector<std::string> knownSensorModels();

/// A sensor with these beams, from lowest to highest.
/// Throws std::invalid_argument unless there are 2 to 256 finite, strictly increasing elevations
/// within +-90 degrees.
SensorModel customSensorModel(const std::vector<double>& elevations_deg);

}  // namespace hagen
