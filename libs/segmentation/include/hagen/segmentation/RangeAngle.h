#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/PixelDirections.h>

namespace hagen {

/// Stage 6, the range-angle image (section III-C): row r of the (I_h - 1) x I_w result is the slope
/// between the returns of beams r and r + 1 of a column,
///
///   alpha = atan2(|d_{r+1} sin e_{r+1} - d_r sin e_r|, |d_{r+1} cos e_{r+1} - d_r cos e_r|)
///
/// with depth d and the beam's elevation e: 0 on level ground, pi/2 on a wall. NaN where either
/// pixel is empty.
void rangeAngles(const Image<float>& depth_m, const PixelDirections& directions,
                 Image<float>& range_angle_rad);

/// The angle that each of the I_h x I_w pixels carries: the one with the beam above it; where there
/// is none, the one with the beam below; NaN where there is neither, or the pixel itself is empty.
void carryAngles(const Image<float>& range_angle_rad, Image<float>& pixel_angle_rad);

}  // namespace hagen
