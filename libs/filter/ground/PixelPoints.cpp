#include <hagen/filter/PixelPoints.h>
#include <cstdint>

namespace hagen {

void locatePixels(const Scan& scan, const PixelDirections& directions, const RangeImage& image,
                  const Image<float>& depth_m, PixelPoints& pixels) {
    const Eigen::Index rows = depth_m.rows(), columns = depth_m.cols();
    for (auto* coordinate : {&pixels.x_m, &pixels.y_m, &pixels.z_m}) {
        coordinate->resize(rows, columns);
    }
    const float* const scan_x_m = scan.x_m.data();
    const float* const scan_y_m = scan.y_m.data();
    const float* const scan_z_m = scan.z_m.data();
    for (Eigen::Index column = 0; column < columns; ++column) {
        const std::int32_t* const closest = image.closest_return.data() + column * rows;
        const float* const depth = depth_m.data() + column * rows;
        float* const x_m = pixels.x_m.data() + column * rows;
        float* const y_m = pixels.y_m.data() + column * rows;
        float* const z_m = pixels.z_m.data() + column * rows;
        for (Eigen::Index row = 0; row < rows; ++row) {
            const std::int32_t i = closest[row];
            if (i != RangeImage::kNoReturn) {
                x_m[row] = scan_x_m[i];
                y_m[row] = scan_y_m[i];
                z_m[row] = scan_z_m[i];
            } else {  // repaired, or empty (NaN)
                const float level_m = depth[row] * directions.row_cosine[row];
                x_m[row] = level_m * directions.column_cosine[column];
                y_m[row] = level_m * directions.column_sine[column];
                z_m[row] = depth[row] * directions.row_sine[row];
            }
        }
    }
}

void movePixels(const Eigen::Isometry3f& to_from_here, PixelPoints& pixels) {
    const Eigen::Matrix3f turn = to_from_here.linear();
    const Eigen::Vector3f shift_m = to_from_here.translation();
    float* const x_m = pixels.x_m.data();
    float* const y_m = pixels.y_m.data();
    float* const z_m = pixels.z_m.data();
    for (Eigen::Index pixel = 0; pixel < pixels.x_m.size(); ++pixel) {
        const float x = x_m[pixel], y = y_m[pixel], z = z_m[pixel];
        x_m[pixel] = turn(0, 0) * x + turn(0, 1) * y + turn(0, 2) * z + shift_m.x();
        y_m[pixel] = turn(1, 0) * x + turn(1, 1) * y + turn(1, 2) * z + shift_m.y();
        z_m[pixel] = turn(2, 0) * x + turn(2, 1) * y + turn(2, 2) * z + shift_m.z();
    }
}

}  // namespace hagen
