#pragma once
#include <hagen/scan/Image.h>
#include <hagen/scan/Scan.h>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace hagen {

/// A box along the axes of the sensor frame; each component of low_m is below that of high_m.
struct AirframeBox {
    Eigen::Vector3f low_m, high_m;
};
struct AirframeSphere {
    Eigen::Vector3f centre_m;
    float radius_m;
};

/// The vehicle that carries the sensor, as far as the sensor sees it: legs, rotors, other payload.
/// In the frame of the sensor itself, however it is mounted. Empty by default.
struct Airframe {
    std::vector<AirframeBox> boxes;
    std::vector<AirframeSphere> spheres;
    /// The range up to which returns are the airframe's, by direction; 0: none. Bins are squares in
    /// azimuth and elevation of 180 degrees / rows. Row 0 starts at elevation -90 degrees; column 0
    /// starts at azimuth -180 degrees, and columns run counter-clockwise. Twice as many columns as
    /// rows, or empty.
    Image<float> bin_range_m;

    bool isEmpty() const { return boxes.empty() && spheres.empty() && bin_range_m.size() == 0; }
};

/// The bin of a direction in an image with this many rows, as in Airframe::bin_range_m.
struct AirframeBin {
    int row, column;
};
/// Requires a point with finite coordinates other than the origin.
AirframeBin airframeBinOf(const Eigen::Vector3f& point_m, int rows);

/// Gives each return in a box, in a sphere or within the range of its bin (borders included) the
/// range NaN, "no range": every later stage ignores it, and its label is Unclassified. Its
/// coordinates stay. Returns how many were masked; those without a range before do not count.
/// Requires ranges. Costs nothing for an empty airframe; otherwise one comparison of the range of
/// each return, and more only for those nearer than the farthest part of the airframe.
std::size_t maskAirframe(const Airframe& airframe, Scan& scan);

}  // namespace hagen
