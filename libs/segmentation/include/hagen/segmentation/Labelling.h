#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/Label.h>
#include <hagen/segmentation/Options.h>

namespace hagen {

/// Stage 8, labelling (section III-E, breadth-first there; the order changes nothing). Regions grow
/// from seeds over the 4-neighbourhood (azimuth wrapped) from a pixel to those whose angle differs
/// by less than `beta_rad`; empty pixels, and pixels without an angle, are not crossed.
///
/// Seeds::Lowest: the lowest pixel of each column is a seed, its region ROU, the rest RoI.
/// Seeds::TopAndNearest: the highest and the nearest pixel of each column are seeds, their regions
/// RoI, the rest ROU.
/// In both, a pixel with depth but without any angle is RoI, the safe side; as the lowest of its
/// column it seeds nothing, and neither does the pixel above the gap.
///
/// `depth_m` and `pixel_angle_rad` are of one size, NaN where there is no value; empty pixels are
/// labelled Unclassified.
/// Of the lowest pixels, only those whose angle passes `seed_gate_rad` are seeds (SeedGate.h); pi/2
/// or more lets all pass.
void labelRegions(const Image<float>& depth_m, const Image<float>& pixel_angle_rad, float beta_rad,
                  Seeds seeds, float seed_gate_rad, Image<Label>& labels);

/// Stage 11, the avoidance zone: pixels whose depth exceeds `zone_m` become ROU.
void limitToZone(const Image<float>& depth_m, float zone_m, Image<Label>& labels);

}  // namespace hagen
