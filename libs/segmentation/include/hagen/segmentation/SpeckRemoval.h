#pragma once
#include <hagen/range_image/Image.h>
#include <hagen/range_image/Label.h>
#include <hagen/segmentation/PixelPoints.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// The memory of removeSpecks(). Keep it from scan to scan, so that none is allocated; it carries
/// nothing over. Images are stored column by column with a border: empty pixels above and below
/// each column; the last column before the first, and the first after the last. So a neighbour is
/// at the same offset from every pixel. There is room for whole vectors behind the end.
struct SpeckWorkspace {
    std::vector<std::int16_t> distance;  ///< from the sensor, along the ground, in 1/64 m
    std::vector<std::int16_t> doubt;     ///< all bits set where the label may change, else 0
    std::vector<std::int16_t> vote;      ///< for RoI or for ROU; 0 where a pixel is empty
    std::vector<std::uint8_t> elected;   ///< the new label, or 0 where it stays as it is
};

/// A majority vote among each pixel and its 8 neighbours, where the pixel's height is within 0.2 m
/// of the tolerance: a lone speck follows the majority. Neighbours whose distance along the ground
/// differs by more than 1 m (both to the nearest 1/64 m, and 511 m at most) do not vote. Pixels
/// that are clearly higher keep their labels: a wire is a speck too. With fewer than 3 votes, or a
/// tie, nothing changes. Votes are the labels before the call.
void removeSpecks(const PixelPoints& pixels, const Image<float>& height_m,
                  const Image<float>& tolerance_m, Image<Label>& labels, SpeckWorkspace& work);

}  // namespace hagen
