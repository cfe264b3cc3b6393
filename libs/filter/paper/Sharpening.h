#pragma once
#include <hagen/filter/PersistentMaxima.h>
#include <hagen/scan/Image.h>
#include <vector>

namespace hagen {

/// Stage 4, sharpening: the modified bilateral filter of section III-B, applied to the maxima only,
///
///   I_f(x) = I(x) + sum_i I(x_i) g_r(|I(x_i) - I(x)|) g_s(|x_i - x|) / sum_i g_r g_s
///
/// over the 8 neighbours x_i (azimuth wrapped), without empty ones; g_s and g_r are Gaussians of
/// `sigma_px` pixels and `sigma_m` metres. The image I is proximity or depth. Maxima without
/// neighbours, and pixels that are not maxima, keep their values. If `by_neighbours` is false, the
/// sum is over I(x), as printed in the paper; then the weights cancel to I_f(x) = 2 I(x).
/// `sharpened_m` must not be the same image as `image_m`.
void sharpenMaxima(const Image<float>& image_m, const std::vector<Maximum>& maxima, float sigma_px,
                   float sigma_m, Image<float>& sharpened_m, bool by_neighbours = true);

/// Stage 5, merge: the mean of proximity and sharpened proximity, converted back to depth. Only
/// maxima move, and only closer, usually to the limit `min_range_m` ("maximizing intensities").
/// `merged_m` must not be the same image as `depth_m`.
void mergeMaxima(const Image<float>& depth_m, const Image<float>& proximity_m,
                 const Image<float>& sharpened_m, const std::vector<Maximum>& maxima,
                 float min_range_m, Image<float>& merged_m);

/// The merge if depth was sharpened: the mean of depth and sharpened depth. Only maxima move, and
/// only away. `merged_m` must not be the same image as `depth_m`.
void mergeDepths(const Image<float>& depth_m, const Image<float>& sharpened_m,
                 const std::vector<Maximum>& maxima, Image<float>& merged_m);

}  // namespace hagen
