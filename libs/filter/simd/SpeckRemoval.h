#pragma once
#include <hagen/filter/PixelPoints.h>
#include <hagen/scan/Image.h>
#include <hagen/scan/Label.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// Workspace of removeSpecks(). Reuse it between scans to avoid allocations; it has no state.
/// Images are stored column by column with a border: empty pixels above and below each column, and
/// wrapped copies of the last and first columns. Neighbours are thus at constant offsets. Memory
/// past the end has room for whole vectors.
struct SpeckWorkspace {
    std::vector<std::int16_t> distance;  ///< horizontal distance from the sensor in 1/64 m
    std::vector<std::int16_t> doubt;     ///< all bits set if the label may change, otherwise 0
    std::vector<std::int16_t> vote;      ///< for RoI or for ROU; 0 for empty pixels
    std::vector<std::uint8_t> elected;   ///< the new label, or 0 to keep the old one
};

/// If a pixel's height is within 0.2 m of the tolerance, relabels the pixel by majority vote with
/// its 8 neighbours, which removes isolated specks. Neighbours whose horizontal distance from the
/// sensor differs by more than 1 m (both rounded to 1/64 m, and limited to 511 m) do not vote.
/// Clearly higher pixels keep their labels, because a wire is a speck, too. With fewer than 3
/// votes, or with a tie, the label is kept. Votes are the labels before the call.
void removeSpecks(const PixelPoints& pixels, const Image<float>& height_m,
                  const Image<float>& tolerance_m, Image<Label>& labels, SpeckWorkspace& work);

}  // namespace hagen
