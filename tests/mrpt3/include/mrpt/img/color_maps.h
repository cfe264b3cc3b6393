#pragma once
// In version 3, colour maps return a TColorf.
#include_next <mrpt/img/color_maps.h>

namespace mrpt::img {
inline TColorf colormapOf3(const TColormap& map, float value) {
    return TColorf(colormap(map, value));
}
}  // namespace mrpt::img
#define colormap colormapOf3
