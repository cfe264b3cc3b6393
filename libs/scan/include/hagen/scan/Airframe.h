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

/// The parts of the vehicle that the sensor sees, such as legs, rotors and other payload, in the
/// sensor frame, regardless of its mount. Empty by default.
struct Airframe {
    std::vector<AirframeBox> boxes;
    std::vector<AirframeSphere> spheres;
    /// Range within which returns belong to the airframe, by direction; 0: no airframe. Bins are
    /// squares of 180 degrees / rows in azimuth and elevation. Row 0 starts at elevation -90
    /// degrees; column 0 starts at azimuth -180 degrees, and columns run counter-clockwise. Has
    /// twice as many columns as rows, or is empty.
    Image<float> bin_range_m;

    bool isEmpty() const { return boxes.empty() && spheres.empty() && bin_range_m.size() == 0; }
};

/// The bin of a direction, indexed like Airframe::bin_range_m.
struct AirframeBin {
    int row, column;
};
/// Requires finite coordinates other than the origin.
AirframeBin airframeBinOf(const Eigen::Vector3f& point_m, int rows);

/// Sets the range of each return in a box, in a sphere or within the range of its bin (inclusive)
/// to NaN, "no range": later stages ignore the return and label it Unclassified. Keeps coordinates.
/// Returns the number of returns masked, without those that already had no range. Requires ranges.
/// Takes no time for an empty airframe; otherwise, returns beyond the farthest part of the airframe
/// take one comparison each.
std::size_t maskAirframe(const Airframe& airframe, Scan& scan);

}  // namespace hagen
