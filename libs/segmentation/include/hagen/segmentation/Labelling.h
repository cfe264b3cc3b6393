#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/Label.h>
#include <hagen/segmentation/ColumnBits.h>
#include <hagen/segmentation/Options.h>
#include <vector>

namespace hagen {

/// The memory of labelRegions(). Keep it from scan to scan, so that none is allocated; it carries
/// nothing over.
struct LabellingWorkspace {
    ColumnBits present;        ///< the pixels with a depth
    ColumnLinks angles;        ///< those with an angle, and the steps between them that are small
    ColumnBits reached;        ///< at first the seeds, then what their regions have reached
    std::vector<int> seeds;    ///< as pixel indices
    std::vector<int> waiting;  ///< columns whose neighbours may still be reached from them
    std::vector<int> is_waiting;  ///< for each column
    std::vector<float> seam;      ///< copies of the columns at both ends of the image
};

/// Stage 8, labelling (section III-E; breadth-first there, but the order changes nothing). Regions
/// grow from seeds over the 4-neighbourhood (azimuth wrapped) to pixels whose angle differs by less
/// than `beta_rad`; empty pixels, and pixels without an angle, are not crossed.
///
/// Seeds::Lowest: the lowest pixel of each column is a seed, its region ROU, the rest RoI.
/// Seeds::TopAndNearest: the highest and the nearest pixel of each column are seeds, their regions
/// RoI, the rest ROU.
/// Either way, a pixel with a depth but no angle is RoI, the safe side; if it is the lowest of its
/// column, neither it nor the pixel above the gap is a seed.
///
/// `depth_m` and `pixel_angle_rad` have the same size, NaN where there is no value; empty pixels
/// are labelled Unclassified. Of the lowest pixels, only those whose angle passes `seed_gate_rad`
/// are seeds (SeedGate.h); pi/2 or more lets all pass.
void labelRegions(const Image<float>& depth_m, const Image<float>& pixel_angle_rad, float beta_rad,
                  Seeds seeds, float seed_gate_rad, Image<Label>& labels, LabellingWorkspace& work);

/// Stage 11, the avoidance zone: pixels whose depth exceeds `zone_m` become ROU.
void limitToZone(const Image<float>& depth_m, float zone_m, Image<Label>& labels);

}  // namespace hagen
