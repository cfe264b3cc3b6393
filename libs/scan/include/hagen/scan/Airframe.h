#pragma once
#include <hagen/scan/Image.h>
#include <hagen/scan/Scan.h>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace hagen {

/// A box aligned with the axes of the sensor frame; low_m is less than high_m in each component.
struct AirframeBox {
    Eigen::Vector3f low_m, high_m;
};
struct AirframeSphere {
    Eigen::Vector3f centre_m;
    float radius_m;
};

/// The parts of the vehicle that the sensor sees: legs, rotors, other payload. In the sensor's own
/// frame, regardless of its mount. Empty by default.
struct Airframe {
    std::vector<AirframeBox> boxes;
    std::vector<AirframeSphere> spheres;
    /// The range within which returns belong to the airframe, by direction; 0: none. Bins are
    /// squares of 180 degrees / rows in azimuth and elevation. Row 0 starts at elevation -90
    /// degrees; column 0 starts at azimuth -180 degrees, and columns run counter-clockwise. Twice
    /// as many columns as rows, or empty.
    Image<float> bin_range_m;

    bool isEmpty() const { return boxes.empty() && spheres.empty() && bin_range_m.size() == 0; }
};

/// The bin of a direction in an image with this many rows, as in Airframe::bin_range_m.
struct AirframeBin {
    int row, column;
};
/// Requires finite coordinates other than the origin.
AirframeBin airframeBinOf(const Eigen::Vector3f& point_m, int rows);

/// Sets the range of each return in a box, in a sphere or within the range of its bin (borders
/// included) to NaN, "no range": all later stages ignore the return, and its label is Unclassified.
/// Coordinates are kept. Returns the number of returns masked, without those that had no range
/// before. Requires ranges. An empty airframe costs no time; otherwise only returns nearer than the
/// farthest part of the airframe take more than one comparison.
std::size_t maskAirframe(const Airframe& airframe, Scan& scan);

}  // namespace hagen
