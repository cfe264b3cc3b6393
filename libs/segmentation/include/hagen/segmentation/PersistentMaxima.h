#pragma once
#include <hagen/range_image/Image.h>
#include <vector>

namespace hagen {

/// A local maximum of proximity and the interval of levels over which it lives (section III-B).
struct Maximum {
    int row, column;
    float birth_m;  ///< proximity of the pixel itself
    float death_m;  ///< level at which its component meets an older one; 0 where it meets none

    float persistence_m() const { return birth_m - death_m; }
};

/// Proximity, in which the closest object is the highest: max(0, zone_m - depth). Empty pixels
/// (NaN) stay empty; pixels at the zone's edge and beyond have proximity 0.
void proximityOf(const Image<float>& depth_m, float zone_m, Image<float>& proximity_m);

/// Stage 3, local maxima by 0-dimensional persistent homology: the components of
/// {proximity >= level}, 8-neighbourhood, azimuth wrapped, as the level sinks from the highest
/// pixel to 0, the edge of the zone. A component is born at its highest pixel; where two meet, the
/// younger dies (elder rule). Of two pixels or components equally high the one with the smaller
/// pixel index (column * rows + row) is the older, so that a plateau has one maximum and the answer
/// is unique. A component that meets no older one dies at 0. Empty pixels, and those with proximity
/// 0, take no part.
///
/// Gives the maxima whose persistence is at least `min_persistence_m` and above 0, from the oldest
/// to the youngest.
void findPersistentMaxima(const Image<float>& proximity_m, float min_persistence_m,
                          std::vector<Maximum>& maxima);

}  // namespace hagen
