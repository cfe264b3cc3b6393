#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/segmentation/CriticalPixels.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// A local maximum of proximity and the interval of levels over which it lives (section III-B).
struct Maximum {
    int row, column;
    float birth_m;  ///< proximity of the pixel itself
    float death_m;  ///< level at which its component meets an older one; 0 where it meets none

    float persistence_m() const { return birth_m - death_m; }
};

/// The memory of findPersistentMaxima(). Keep it from scan to scan, so that none is allocated; it
/// carries nothing over. Maxima go by their number in `critical.maximum`, which is in pixel order.
struct MaximaWorkspace {
    /// Where the components born at two maxima meet.
    struct Meeting {
        float level_m;
        std::int32_t maximum, other;
    };

    FramedLevels proximity_m;
    CriticalPixels critical;
    std::vector<Meeting> meetings;
    std::vector<std::int32_t> elder;  ///< for each maximum, an older one it has met, or itself
    std::vector<float> birth_m, death_m;
    std::vector<std::uint64_t> order, swap;
};

/// Proximity, in which the closest object is the highest: max(0, zone_m - depth). Empty pixels
/// (NaN) stay empty; pixels at the zone's edge and beyond have proximity 0.
void proximityOf(const Image<float>& depth_m, float zone_m, Image<float>& proximity_m);

/// Stage 3, local maxima by 0-dimensional persistent homology: the components of
/// {proximity >= level}, 8-neighbourhood, azimuth wrapped, as the level sinks from the highest
/// pixel to 0, the edge of the zone. A component is born at its highest pixel; where two meet, the
/// younger dies (elder rule). Of two equally high pixels or components the one with the smaller
/// pixel index (column * rows + row) is the older, so a plateau has one maximum and the result is
/// unique. A component that meets no older one dies at 0. Empty pixels, and those with proximity 0,
/// are ignored.
///
/// Returns in `maxima` those whose persistence is at least `min_persistence_m` and above 0, from
/// the oldest to the youngest.
void findPersistentMaxima(const Image<float>& proximity_m, float min_persistence_m,
                          std::vector<Maximum>& maxima, MaximaWorkspace& work);

}  // namespace hagen
