#pragma once
#include <hagen/scan/Image.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen {

/// The depth image of a scan, and the pixel of each return (section III-A).
struct RangeImage {
    /// I_h x I_w: range of the closest return in each pixel, metres; NaN if there is none.
    Image<float> depth_m;
    /// I_h x I_w: index of the closest return (the first of equally close returns), or kNoReturn.
    Image<std::int32_t> closest_return;
    /// The inverse of the paper's depth_mapper: the pixel of each return (column * I_h + row), or
    /// kNoPixel if the return is beyond the context or outside the sensor's range limits. A pixel
    /// may have several returns.
    std::vector<std::int32_t> depth_mapper;

    static constexpr std::int32_t kNoPixel = -1;
    static constexpr std::int32_t kNoReturn = -1;
};

/// Workspace of projectScan(). Reuse it between scans to avoid allocations.
struct ProjectionWorkspace {
    /// The closest return of each pixel so far: range and index, packed into one number.
    std::vector<double> closest;
};

/// Stage 1, the depth image: projects each return to the row of its beam and the closest of
/// `columns` azimuths; a pixel keeps its closest return. Column 0 faces backwards, the middle
/// column along x; columns run clockwise, so left in the image is left of the sensor. Drops returns
/// outside the sensor's range limits or farther than `context_m`. Throws std::invalid_argument if
/// the scan was not located with this sensor (checkLocated() in Scan.h). Reuses the memory of
/// `image`.
void projectScan(const Scan& scan, const SensorModel& sensor, int columns, float context_m,
                 RangeImage& image, ProjectionWorkspace& work);

/// Lets the first `first` returns decide the pixels that they hit: the closest of them counts, even
/// if another return is closer. For a sliding window, whose older scans then only fill gaps.
void preferFirst(const Scan& scan, std::size_t first, RangeImage& image);

/// The column whose centre is closest to this azimuth, in an image with `columns` columns.
int nearestColumn(float azimuth_rad, int columns);

/// The azimuth in (-pi, pi] at the centre of a column.
float columnAzimuth(int column, int columns);

}  // namespace hagen
