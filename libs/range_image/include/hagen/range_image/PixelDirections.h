#pragma once
#include <hagen/range_image/SensorModel.h>
#include <vector>

namespace hagen {

/// Where the pixels of a range image look, as sines and cosines: of each row's elevation and of
/// each column's azimuth. They are the same for every scan; whoever holds them needs no
/// trigonometry a pixel.
struct PixelDirections {
    std::vector<float> row_sine, row_cosine;        ///< I_h, of the elevation above the xy plane
    std::vector<float> column_sine, column_cosine;  ///< I_w, of the azimuth from x
};

/// Those of `columns` columns of this sensor.
PixelDirections pixelDirections(const SensorModel& sensor, int columns);

}  // namespace hagen
