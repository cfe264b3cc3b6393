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
    for (Eigen::Index pixel = 0; pixel < pixels.x_m.size(); ++pixel) {
        pixels.set(pixel, to_from_here * pixels.at(pixel));
    }
}

}  // namespace hagen
