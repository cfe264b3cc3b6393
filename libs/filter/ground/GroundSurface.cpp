#include <hagen/filter/GroundSurface.h>
#include <algorithm>

namespace hagen {

float GroundSurface::at(float x_m, float y_m) const {
    const auto cells = [](float coordinate_m) {
        return std::clamp(coordinate_m * (1 / kCell_m) + (0.5f * kCells - 0.5f), 0.0f,
                          static_cast<float>(kCells - 1));
    };
    const float u = cells(x_m), v = cells(y_m);
    const int i = std::min(static_cast<int>(u), kCells - 2);
    const int j = std::min(static_cast<int>(v), kCells - 2);
    const float to_next_i = u - static_cast<float>(i), to_next_j = v - static_cast<float>(j);
    const auto alongJ = [&](int k) {
        return height_m(k, j) + to_next_j * (height_m(k, j + 1) - height_m(k, j));
    };
    return alongJ(i) + to_next_i * (alongJ(i + 1) - alongJ(i));
}

void heightsAbove(const GroundSurface& surface, const PixelPoints& pixels, Image<float>& height_m) {
    height_m.resize(pixels.z_m.rows(), pixels.z_m.cols());
    heightsAbove(surface, pixels.x_m.size(), pixels.x_m.data(), pixels.y_m.data(),
                 pixels.z_m.data(), height_m.data());
}

}  // namespace hagen
