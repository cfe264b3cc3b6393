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
    /// Returns outside these limits are not in the image. Within the zone, they are RoI untested.
    float min_range_m = 0.5f;
    float max_range_m = 130.0f;
    /// True if the beams above are real. A sensor that scans without rings has virtual beams, and a
    /// return belongs to the nearest one.
    bool has_rings = true;

    /// True if the range is within the limits; false for NaN.
    bool sees(float range_m) const { return range_m >= min_range_m && range_m <= max_range_m; }

    int rows() const { return static_cast<int>(elevations_rad.size()); }

    /// The row of the beam closest in elevation (the lower row if two are equally close).
    int nearestRow(float elevation_rad) const;
};

/// Returns a known sensor by its name in settings files: "VLP-16", "HDL-32E", "HDL-64E", "Puck
/// Hi-Res", "VLP-32C", "VLS-128", "XT32", "XT16", "OS0-128", "OS1-64", "Mid-360", "Avia", "HAP".
/// Elevations and range limits are from the manufacturer's data sheets. Throws
/// std::invalid_argument listing the known names for any other name.
///
/// - OS0-128 and OS1-64: data sheets of revision 7. Beams are evenly spaced over +-45 and +-21.2
///   degrees, ranges 0.5 to 100 m and 0.5 to 200 m. (0.5 m is the default; the sensors can be
///   configured to report nearer returns, and an OS0 before revision 7 measured from 0.3 m.) The
///   real beams in a sensor's metadata differ by a few tenths of a degree: use customSensorModel().
/// - Mid-360: Livox Mid-360 User Manual (2023), specifications: 0.1 m (blind zone) to 70 m (80 %
///   reflectivity), -7 to 52 degrees. It has no rings; 24 virtual beams, 2.5 degrees apart, cover
///   that field of view. Elevations are relative to the sensor's own axes, upside down or not.
/// - Avia and HAP: Livox User Manuals (2020, 2022): 1 m to 450 m (80 % reflectivity, in the dark)
/// in
///   70.4 x 77.2 degrees, 0.5 m to 150 m (10 %) in 120 x 25 degrees. Both have no rings; 40 and 16
///   virtual beams. Smaller pixels lowered the scores of simulated flights.
SensorModel sensorModel(const std::string& name);

/// The names accepted by sensorModel().
std::vector<std::string> knownSensorModels();

/// A sensor with these beams, from lowest to highest.
/// Throws std::invalid_argument unless there are 2 to 256 finite, strictly increasing elevations
/// within +-90 degrees.
SensorModel customSensorModel(const std::vector<double>& elevations_deg);

}  // namespace hagen
