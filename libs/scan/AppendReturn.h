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

/// Calls visit(a, b) for each pair of corresponding arrays of two scans.
template <class A, class B, class Visit>
void forEachArray(A& a, B& b, Visit visit) {
    visit(a.x_m, b.x_m);
    visit(a.y_m, b.y_m);
    visit(a.z_m, b.z_m);
    visit(a.intensity, b.intensity);
    visit(a.range_m, b.range_m);
    visit(a.azimuth_rad, b.azimuth_rad);
    visit(a.row, b.row);
}

/// Appends all returns of a scan to another.
inline void appendReturns(const Scan& from, Scan& to) {
    forEachArray(from, to, [](const auto& values, auto& all) {
        all.insert(all.end(), values.begin(), values.end());
    });
}

}  // namespace hagen
