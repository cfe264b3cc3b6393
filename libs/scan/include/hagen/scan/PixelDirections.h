#pragma once
#include <hagen/scan/SensorModel.h>
#include <vector>

namespace hagen {

/// The directions of a range image's pixels, as sines and cosines of each row's elevation and each
/// column's azimuth. They are the same for every scan, which avoids trigonometry per pixel.
struct PixelDirections {
    std::vector<float> row_sine, row_cosine;        ///< I_h, of the elevation above the xy plane
    std::vector<float> column_sine, column_cosine;  ///< I_w, of the azimuth from x
};

/// The directions for an image of `columns` columns.
PixelDirections pixelDirections(const SensorModel& sensor, int columns);

}  // namespace hagen
