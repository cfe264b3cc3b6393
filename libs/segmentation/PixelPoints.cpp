#include <hagen/segmentation/PixelPoints.h>

namespace hagen {

void locatePixels(const Scan& scan, const PixelDirections& directions, const RangeImage& image,
                  const Image<float>& depth_m, PixelPoints& pixels) {
    const int rows = static_cast<int>(depth_m.rows()), columns = static_cast<int>(depth_m.cols());
    for (auto* coordinate : {&pixels.x_m, &pixels.y_m, &pixels.z_m}) {
        coordinate->setConstant(rows, columns, kNoValue);
    }
    for (Eigen::Index pixel = 0; pixel < depth_m.size(); ++pixel) {
        const std::int32_t i = image.closest_return.data()[pixel];
        if (i != RangeImage::kNoReturn) {
            pixels.set(pixel, {scan.x_m[i], scan.y_m[i], scan.z_m[i]});
        } else if (hasValue(depth_m.data()[pixel])) {
            const Eigen::Index row = pixel % rows, column = pixel / rows;
            const float level_m = depth_m.data()[pixel] * directions.row_cosine[row];
            pixels.set(pixel, {level_m * directions.column_cosine[column],
                               level_m * directions.column_sine[column],
                               depth_m.data()[pixel] * directions.row_sine[row]});
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
