#include <hagen/range_image/Angle.h>
#include <hagen/range_image/RangeImage.h>
#include <cmath>

namespace hagen {

int nearestColumn(float azimuth_rad, int columns) {
    const float turn = 0.5f - azimuth_rad * static_cast<float>(0.5 / kPi);  // clockwise from behind
    const int column = static_cast<int>(std::floor(turn * static_cast<float>(columns)));
    return wrapColumn(column, columns);
}

float columnAzimuth(int column, int columns) {
    return static_cast<float>(kPi - 2.0 * kPi * (column + 0.5) / columns);
}

void projectScan(const Scan& scan, const SensorModel& sensor, int columns, float context_m,
                 RangeImage& image) {
    image.depth_m.setConstant(sensor.rows(), columns, kNoValue);
    image.closest_return.setConstant(sensor.rows(), columns, RangeImage::kNoReturn);
    image.depth_mapper.resize(scan.size());
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const float range_m = scan.range_m[i];
        if (!sensor.sees(range_m) || range_m > context_m) {
            image.depth_mapper[i] = RangeImage::kNoPixel;
            continue;
        }
        const int column = nearestColumn(scan.azimuth_rad[i], columns);
        float& depth_m = image.depth_m(scan.row[i], column);
        if (!(depth_m <= range_m)) {  // empty, or farther
            depth_m = range_m;
            image.closest_return(scan.row[i], column) = static_cast<std::int32_t>(i);
        }
        image.depth_mapper[i] = column * sensor.rows() + scan.row[i];
    }
}

ReturnsByPixel returnsByPixel(const RangeImage& image) {
    ReturnsByPixel by_pixel;
    by_pixel.first.assign(image.depth_m.size() + 1, 0);
    for (const std::int32_t pixel : image.depth_mapper) {
        if (pixel != RangeImage::kNoPixel) ++by_pixel.first[pixel + 1];
    }
    for (std::size_t p = 1; p < by_pixel.first.size(); ++p)
        by_pixel.first[p] += by_pixel.first[p - 1];
    by_pixel.returns.resize(by_pixel.first.back());
    std::vector<std::int32_t> next(by_pixel.first.begin(), by_pixel.first.end() - 1);
    for (std::size_t i = 0; i < image.depth_mapper.size(); ++i) {
        const std::int32_t pixel = image.depth_mapper[i];
        if (pixel != RangeImage::kNoPixel) {
            by_pixel.returns[next[pixel]++] = static_cast<std::int32_t>(i);
        }
    }
    return by_pixel;
}

}  // namespace hagen
