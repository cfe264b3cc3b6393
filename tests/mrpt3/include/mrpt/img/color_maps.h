#pragma once
// Colour maps return a TColorf in version 3.
#include_next <mrpt/img/color_maps.h>

namespace mrpt::img {
inline TColorf colormapOf3(const TColormap& map, float value) {
    return TColorf(colormap(map, value));
}
}  // namespace mrpt::img
#define colormap colormapOf3
