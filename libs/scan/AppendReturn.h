#pragma once
#include <hagen/scan/Scan.h>
#include <cstddef>

namespace hagen {

/// Appends return `i` of a scan to another: coordinates, intensity, range, azimuth and row. `from`
/// must have all of these arrays. Inline because it is called for each return.
inline void appendReturn(const Scan& from, std::size_t i, Scan& to) {
    to.x_m.push_back(from.x_m[i]);
    to.y_m.push_back(from.y_m[i]);
    to.z_m.push_back(from.z_m[i]);
    to.intensity.push_back(from.intensity[i]);
    to.range_m.push_back(from.range_m[i]);
    to.azimuth_rad.push_back(from.azimuth_rad[i]);
    to.row.push_back(from.row[i]);
}

}  // namespace hagen
