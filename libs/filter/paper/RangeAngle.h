#pragma once
#include <hagen/scan/Image.h>
#include <hagen/scan/PixelDirections.h>

namespace hagen {

/// Stage 6, the range-angle image (section III-C): row r of the (I_h - 1) x I_w result is the slope
/// between the returns of beams r and r + 1 in a column,
///
///   alpha = atan2(|d_{r+1} sin e_{r+1} - d_r sin e_r|, |d_{r+1} cos e_{r+1} - d_r cos e_r|)
///
/// with depth d and beam elevation e: 0 on level ground, pi/2 on a wall. NaN if either pixel is
/// empty.
void rangeAngles(const Image<float>& depth_m, const PixelDirections& directions,
                 Image<float>& range_angle_rad);

/// Sets the angles that are NaN to 0, as if the image of angles had been 0 from the beginning.
void levelGaps(Image<float>& range_angle_rad);

/// The angle of each of the I_h x I_w pixels: the one to the beam above it; if there is none, the
/// one to the beam below; NaN if there is neither. An empty pixel has none, unless levelGaps() gave
/// it some. `to_beam_above` false: the one to the beam below, if there is one.
void carryAngles(const Image<float>& range_angle_rad, Image<float>& pixel_angle_rad,
                 bool to_beam_above = true);

}  // namespace hagen
