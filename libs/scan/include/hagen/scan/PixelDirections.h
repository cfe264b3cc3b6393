#pragma once
#include <hagen/scan/SensorModel.h>
#include <vector>

namespace hagen {

/// The directions of a range image's pixels, as sines and cosines of row elevations and column
/// azimuths. Reused for all scans, to avoid trigonometry per pixel.
struct PixelDirections {
    std::vector<float> row_sine, row_cosine;        ///< I_h, of the elevation above the xy plane
    std::vector<float> column_sine, column_cosine;  ///< I_w, of the azimuth from x
};

/// Computes the directions for an image with this many columns.
PixelDirections pixelDirections(const SensorModel& sensor, int columns);

}  // namespace hagen
