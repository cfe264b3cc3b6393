// The stages of the filters of whole scans and of sectors, in order.
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

/// III-B to III-E: the paper's labels for the pixels of `result.repaired_m`.
void labelByAngles(const PixelDirections& directions, float min_range_m,
                   const std::optional<Attitude>& horizon, const Options& options,
                   SegmentationResult& result, FilterWorkspace& work);

// Beyond the paper: the detected ground improves the ROU labels and reveals insufficient clearance.
// The plane is fitted to `columns` of the image (evenly spaced columns if null).

/// Whether the options require the ground plane.
bool usesGround(const Options& options);

/// Finds the ground plane under pixels up to `max_m` above the sensor, transforms the pixels to its
/// frame, and decides whether ground is visible and has a surface.
void findGroundPlane(const Scan& scan, const PixelDirections& directions,
                     const std::optional<Attitude>& horizon, const Options& options,
                     const std::vector<std::int32_t>* columns, float max_m,
                     SegmentationResult& result, FilterWorkspace& work);

/// Fits the surface under the ROU pixels and computes the heights of all pixels above it.
void findGroundSurface(const Image<Label>& labels, const Options& options,
                       const std::vector<std::int32_t>* columns, Ground& ground,
                       FilterWorkspace& work);

/// Computes the maximum ground height per pixel. Requires `ground.tops` for the same area.
void findTolerances(const Options& options, const CellArea& area, Ground& ground,
                    FilterWorkspace& work);

/// Labels pixels by their height above the surface, if a surface was fitted. If no ground is
/// visible, no pixel is ROU.
void relabelByGround(const Ground& ground, const Options& options, Image<Label>& labels,
                     FilterWorkspace& work);

/// Labels ground that is too close, and returns behind the closest return of their pixel.
void judgeClearance(const Scan& scan, const std::optional<Attitude>& horizon,
                    const Options& options, SegmentationResult& result, FilterWorkspace& work);

/// Fills `components` and `returns.component`. Requires all other parts of the result.
void numberObstacles(const Scan& scan, const Options& options, SegmentationResult& result,
                     FilterWorkspace& work);

}  // namespace hagen
