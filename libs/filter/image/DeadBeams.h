#pragma once
#include <hagen/scan/Image.h>
#include <hagen/scan/PixelDirections.h>
#include <cstdint>
#include <vector>

namespace hagen {

/// Workspace of bridgeDeadBeams(). Reuse it between scans to avoid allocations; it has no state.
struct DeadBeamsWorkspace {
    std::vector<std::uint8_t> is_live;  ///< for each row, whether a pixel has a value
};

/// Stage 2, for dead beams: rows of `depth_m` (metres, NaN empty) without values between rows with
/// values. Their pixels in `repaired_m` get the depth at which their beam crosses the straight line
/// between the pixels below and above, if both have a value; this keeps the ground connected and
/// its slope unchanged. Up to two adjacent rows are bridged; wider gaps stay empty. `repaired_m`
/// has the size of `depth_m`.
void bridgeDeadBeams(const Image<float>& depth_m, const PixelDirections& directions,
                     Image<float>& repaired_m, DeadBeamsWorkspace& work);

}  // namespace hagen
