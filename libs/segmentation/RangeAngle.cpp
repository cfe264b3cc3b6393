#include <hagen/segmentation/RangeAngle.h>
#include <cmath>
#include <vector>

namespace hagen {

void rangeAngles(const Image<float>& depth_m, const PixelDirections& directions,
                 Image<float>& range_angle_rad) {
    const int rows = static_cast<int>(depth_m.rows());
    const std::vector<float>&sines = directions.row_sine, &cosines = directions.row_cosine;
    range_angle_rad.resize(rows - 1, depth_m.cols());
    for (int column = 0; column < depth_m.cols(); ++column) {
        for (int row = 0; row + 1 < rows; ++row) {
            const float below = depth_m(row, column), above = depth_m(row + 1, column);
            const float dz = above * sines[row + 1] - below * sines[row];
            const float dx = above * cosines[row + 1] - below * cosines[row];
            range_angle_rad(row, column) = std::atan2(std::abs(dz), std::abs(dx));
        }
    }
}

void carryAngles(const Image<float>& range_angle_rad, Image<float>& pixel_angle_rad) {
    const int rows = static_cast<int>(range_angle_rad.rows()) + 1;
    pixel_angle_rad.resize(rows, range_angle_rad.cols());
    for (int column = 0; column < range_angle_rad.cols(); ++column) {
        for (int row = 0; row < rows; ++row) {
            const float with_above = row + 1 < rows ? range_angle_rad(row, column) : kNoValue;
            const float with_below = row > 0 ? range_angle_rad(row - 1, column) : kNoValue;
            pixel_angle_rad(row, column) = hasValue(with_above) ? with_above : with_below;
        }
    }
}

}  // namespace hagen
