// The stages in their order, for filters that run them on a whole scan or on a sector of a turn.
#pragma once
#include <hagen/filter/FilterWorkspace.h>
#include <hagen/filter/Levelling.h>
#include <hagen/filter/Options.h>
#include <hagen/filter/SegmentationResult.h>
#include <hagen/scan/PixelDirections.h>
#include <hagen/scan/Scan.h>
#include <cstdint>
#include <optional>
#include <vector>

namespace hagen {

/// The part of an image that is judged, where it has few columns elsewhere.
struct JudgedPart {
    Eigen::Index first, count;  ///< its columns
    /// Columns of the image that are spread over the turn: for the plane, and for the surface.
    const std::vector<std::int32_t>&of_plane, &of_surface;
    const Image<float>&
        known_m;  ///< how high the cell of each pixel is known to be; NaN: not known
};

/// III-B to III-E: the labels that the paper gives to the pixels of a depth image.
void labelByAngles(const Image<float>& depth_m, const PixelDirections& directions,
                   float min_range_m, const std::optional<Attitude>& horizon,
                   const Options& options, SegmentationResult& result, FilterWorkspace& work);

/// Beyond the paper: the ground plane, and if it is seen, the surface under the pixels that are
/// ROU, the height of each pixel above it, and up to which height it is ground: only for the pixels
/// of `part` in the zone, if there is one.
void findGround(const Scan& scan, const PixelDirections& directions,
                const SegmentationResult& of_scan, const std::optional<Attitude>& horizon,
                const Options& options, const JudgedPart* part, Ground& ground,
                FilterWorkspace& work);

/// Beyond the paper: labels pixels by their height above the surface.
void relabelByHeight(const PixelPoints& pixels, const Image<float>& height_m,
                     const Image<float>& tolerance_m, const Options& options, Image<Label>& labels,
                     FilterWorkspace& work);

/// Without ground in sight, nothing is ROU.
void doubtAll(Image<Label>& labels);

}  // namespace hagen
