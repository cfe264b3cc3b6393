#include <hagen/scan/PixelDirections.h>
#include <hagen/scan/RangeImage.h>
#include <cmath>

namespace hagen {

PixelDirections pixelDirections(const SensorModel& sensor, int columns) {
    PixelDirections directions;
    for (const float elevation_rad : sensor.elevations_rad) {
        directions.row_sine.push_back(std::sin(elevation_rad));
        directions.row_cosine.push_back(std::cos(elevation_rad));
    }
    for (int column = 0; column < columns; ++column) {
        const float azimuth_rad = columnAzimuth(column, columns);
        directions.column_sine.push_back(std::sin(azimuth_rad));
        directions.column_cosine.push_back(std::cos(azimuth_rad));
    }
    return directions;
}

}  // namespace hagen
