#pragma once
#include <hagen/filter/PixelPoints.h>

#include <vector>

namespace hagen::test {

/// Pixels at these points in columns of `rows` rows; a point with NaN is an empty pixel.
inline PixelPoints pixelsAt(const std::vector<Eigen::Vector3f>& points_m, int rows = 1) {
    PixelPoints pixels;
    const Eigen::Index columns = static_cast<Eigen::Index>(points_m.size()) / rows;
    for (auto* coordinate : {&pixels.x_m, &pixels.y_m, &pixels.z_m}) {
        coordinate->resize(rows, columns);
    }
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        pixels.set(static_cast<Eigen::Index>(i), points_m[i]);
    }
    return pixels;
}

inline const Eigen::Vector3f kEmptyPixel = Eigen::Vector3f::Constant(kNoValue);

/// Points of the ground z = height(x, y) on a square grid around the sensor.
template <class Height>
std::vector<Eigen::Vector3f> groundPoints(float reach_m, float step_m, Height height) {
    std::vector<Eigen::Vector3f> points;
    const int steps = static_cast<int>(reach_m / step_m);
    for (int i = -steps; i <= steps; ++i) {
        for (int j = -steps; j <= steps; ++j) {
            const float x_m = static_cast<float>(i) * step_m, y_m = static_cast<float>(j) * step_m;
            points.emplace_back(x_m, y_m, height(x_m, y_m));
        }
    }
    return points;
}

}  // namespace hagen::test
