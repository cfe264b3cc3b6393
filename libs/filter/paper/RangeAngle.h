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

/// Sets NaN angles to 0, as if the angle image had been initialised with 0.
void levelGaps(Image<float>& range_angle_rad);

/// The angle of each of the I_h x I_w pixels: to the beam above; if absent, to the beam below (vice
/// versa if not `to_beam_above`); NaN if both are absent. An empty pixel has no angle, unless
/// levelGaps() set it.
void carryAngles(const Image<float>& range_angle_rad, Image<float>& pixel_angle_rad,
                 bool to_beam_above = true);

}  // namespace hagen
