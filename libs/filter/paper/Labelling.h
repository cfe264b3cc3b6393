#pragma once
#include <hagen/filter/Options.h>
#include <hagen/scan/Image.h>
#include <hagen/scan/Label.h>
#include <vector>
#include "filter/ColumnBits.h"

namespace hagen {

/// Workspace of labelRegions(). Reuse it between scans to avoid allocations; it has no state.
struct LabellingWorkspace {
    ColumnBits present;           ///< pixels with a depth
    ColumnLinks angles;           ///< pixels with an angle, and the small steps between them
    ColumnBits reached;           ///< the seeds, then the pixels reached from them
    std::vector<int> seeds;       ///< as pixel indices
    std::vector<int> waiting;     ///< columns that have not spread to their neighbours yet
    std::vector<int> is_waiting;  ///< whether a column is in `waiting`
    std::vector<float> seam;      ///< copies of the first and last columns of the image
};

/// Stage 8, labelling (section III-E, which searches breadth-first; the result does not depend on
/// the order). Regions grow from seeds over the 4-neighbourhood (azimuth wrapped) to pixels whose
/// angle differs by less than `beta_rad`. They do not cross empty pixels or pixels without an
/// angle.
///
/// Seeds::Lowest: the lowest pixel of each column is a seed, its region ROU, the rest RoI.
/// Seeds::TopAndNearest: the highest and the nearest pixel of each column are seeds, their regions
/// RoI, the rest ROU.
/// Seeds::Every: every pixel is a seed and ROU, no regions; for ablations.
///
/// A pixel with a depth but no angle is always RoI, to be safe. If it is the lowest of its column,
/// neither it nor the pixel above the gap is a seed.
///
/// `depth_m` and `pixel_angle_rad` have the same size, NaN for no value; empty pixels are
/// Unclassified and never seeds, even if they have an angle (levelGaps()). The lowest pixels are
/// seeds only if their angle passes `seed_gate_rad` (SeedGate.h); pi/2 or more passes all.
void labelRegions(const Image<float>& depth_m, const Image<float>& pixel_angle_rad, float beta_rad,
                  Seeds seeds, float seed_gate_rad, Image<Label>& labels, LabellingWorkspace& work);

/// Stage 11, the avoidance zone: pixels whose depth exceeds `zone_m` become ROU.
void limitToZone(const Image<float>& depth_m, float zone_m, Image<Label>& labels);

}  // namespace hagen
