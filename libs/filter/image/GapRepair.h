#pragma once
#include <hagen/scan/Image.h>

namespace hagen {

/// Stage 2, gap repair (not in the paper): an empty pixel gets the mean of its neighbours above and
/// below if both have a value and differ by less than `max_step_m`. Reads only `depth_m` (metres,
/// NaN empty), so repaired pixels do not repair others. `repaired_m` must not be the same image as
/// `depth_m`.
void repairGaps(const Image<float>& depth_m, float max_step_m, Image<float>& repaired_m);

}  // namespace hagen
