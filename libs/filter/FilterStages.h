// The stages in their order, for filters that run them on a whole scan or on a sector of a turn.
#pragma once
#include <hagen/filter/CellArea.h>
#include <hagen/filter/Levelling.h>
#include <hagen/filter/Options.h>
#include <hagen/filter/SegmentationResult.h>
#include <hagen/scan/PixelDirections.h>
#include <hagen/scan/Scan.h>
#include <cstdint>
#include <optional>
#include <vector>

#include "filter/FilterWorkspace.h"

namespace hagen {

/// III-B to III-E: the labels that the paper gives to the pixels of `result.repaired_m`.
void labelByAngles(const PixelDirections& directions, float min_range_m,
                   const std::optional<Attitude>& horizon, const Options& options,
                   SegmentationResult& result, FilterWorkspace& work);

// Beyond the paper: what follows uses the detected ground to find what else is ground, and what is
// too close. `columns` of the image are fitted to; null: evenly spread ones.

/// Whether the options need the ground at all.
bool usesGround(const Options& options);

/// The ground plane, the pixels in its frame, and whether it is seen and has a surface.
void findGroundPlane(const Scan& scan, const PixelDirections& directions,
                     const std::optional<Attitude>& horizon, const Options& options,
                     const std::vector<std::int32_t>* columns, SegmentationResult& result,
                     FilterWorkspace& work);

/// The surface under the pixels that are labelled ROU, and the heights of all pixels above it.
void findGroundSurface(const Image<Label>& labels, const Options& options,
                       const std::vector<std::int32_t>* columns, Ground& ground,
                       FilterWorkspace& work);

/// Up to which height each pixel is ground. Requires `ground.tops` of the same area.
void findTolerances(const Options& options, const CellArea& area, Ground& ground,
                    FilterWorkspace& work);

/// Labels pixels by their height above the surface, if there is one. Without ground in sight,
/// nothing is ROU.
void relabelByGround(const Ground& ground, const Options& options, Image<Label>& labels,
                     FilterWorkspace& work);

/// Ground that is too close, and returns behind the closest one of their pixel.
void judgeClearance(const Scan& scan, const std::optional<Attitude>& horizon,
                    const Options& options, SegmentationResult& result, FilterWorkspace& work);

/// Stage 9. Requires `result.components`.
void labelReturns(const Scan& scan, const Options& options, SegmentationResult& result,
                  FilterWorkspace& work);

}  // namespace hagen
