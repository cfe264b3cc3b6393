#pragma once
#include <hagen/filter/PixelCells.h>
#include <hagen/filter/PixelPoints.h>
#include <hagen/scan/Image.h>
#include <hagen/scan/Label.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// Workspace of findLevelPixels(). Reuse it between scans to avoid allocations; it has no state.
struct GroundEvidenceWorkspace {
    std::vector<float> lowest_m;  ///< lowest height in each cell
    /// For each pixel, whether a level step leads to the pixel above (1), the next (2), ... (4),
    /// (8).
    std::vector<std::uint8_t> steps;
};

/// Marks the pixels that look like ground (1, otherwise 0), in the ground frame. A pixel and the
/// one above it in its column form a level step if the upper one is farther out and the slope
/// between them, relative to the plane, is less than 0.3. Walls are too steep, and ceilings come
/// closer with elevation. If the pixel above is empty or less than 0.08 m away (range noise
/// dominates the slope over short distances), the next pixel farther away and the close pixels
/// before it may also form a step, up to the fourth pixel above and up to 2 m. Both pixels of a
/// step are level, unless another pixel of their cell (0.75 m) is more than 0.3 m below: then they
/// are leaves, a table or a roof.
void findLevelPixels(const PixelPoints& pixels, const PixelCells& cells,
                     Image<std::uint8_t>& is_level, GroundEvidenceWorkspace& work);

/// The candidates for the first fit of the ground surface: level ROU pixels stay ROU, all other
/// pixels become unclassified.
void keepLevelRou(const Image<Label>& labels, const Image<std::uint8_t>& is_level,
                  Image<Label>& candidates);

/// Sets the tolerance to minus infinity (RoI at every height) without evidence that the surface is
/// ground, which requires that at least 55 % of the pixels close to the surface (0.2 m, plus 0.005
/// m per metre of distance) within 9 x 9 blocks of 3 m are level. A surface that cuts through
/// walls, trees or furniture has pixels there that are not level. There is no evidence beyond 40
/// times the sensor's height above the ground (at such grazing angles, gaps between plants look
/// like level steps), and none below a height of 0.1 m (on a table). `height_m` is from
/// heightsAbove(); tolerances of empty pixels are NaN. `has_evidence` is the result for each block
/// (PixelCells.h), then false for positions beyond the grid.
void requireEvidence(const PixelPoints& pixels, const PixelCells& cells,
                     const Image<float>& height_m, const Image<std::uint8_t>& is_level,
                     float sensor_height_m, Image<float>& tolerance_m,
                     std::vector<std::uint8_t>& has_evidence);

}  // namespace hagen
