#pragma once
#include <hagen/filter/CriticalPixels.h>
#include <hagen/scan/Image.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// A local maximum of proximity and the interval of levels in which it exists (section III-B).
struct Maximum {
    int row, column;
    float birth_m;  ///< proximity of the pixel itself
    float death_m;  ///< level at which its component meets an older component; 0 if never

    float persistence_m() const { return birth_m - death_m; }
};

/// Workspace of findPersistentMaxima(). Reuse it between scans to avoid allocations; it has no
/// state. Maxima are identified by their index in `critical.maximum`, which is in pixel order.
struct MaximaWorkspace {
    /// A pixel where the components of two maxima meet.
    struct Meeting {
        float level_m;
        std::int32_t maximum, other;
    };

    FramedLevels proximity_m;
    CriticalPixels critical;
    std::vector<Meeting> meetings;
    std::vector<std::int32_t> elder;  ///< for each maximum, an older maximum that it met, or itself
    std::vector<float> birth_m, death_m;
    std::vector<std::uint64_t> order, swap;
};

/// Proximity: max(0, zone_m - depth), highest for the closest object. Empty pixels (NaN) stay
/// empty; pixels at the zone's edge and beyond have proximity 0.
void proximityOf(const Image<float>& depth_m, float zone_m, Image<float>& proximity_m);

/// Stage 3, local maxima by 0-dimensional persistent homology: the components of {proximity >=
/// level}, 8-neighbourhood, azimuth wrapped, as the level decreases from the highest pixel to 0,
/// the edge of the zone. A component is born at its highest pixel; when two meet, the younger one
/// dies (elder rule). Between equally high pixels or components, the smaller pixel index (column *
/// rows + row) is older, so a plateau has one maximum and the result is unique. A component that
/// meets no older component dies at 0. Empty pixels and pixels with proximity 0 are ignored.
///
/// Returns in `maxima` the maxima with a persistence of at least `min_persistence_m` and above 0,
/// oldest first.
void findPersistentMaxima(const Image<float>& proximity_m, float min_persistence_m,
                          std::vector<Maximum>& maxima, MaximaWorkspace& work);

}  // namespace hagen
